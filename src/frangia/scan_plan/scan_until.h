#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/geometry/mesh.h"
#include "frangia/inspection/inspect_part.h"
#include "frangia/inspection/inspection_plan.h"
#include "frangia/inspection/inspection_reference.h"
#include "frangia/scan_plan/scan_need.h"

namespace frangia {

/// A round of `scan_until`: what all stations so far measure.
struct ScanRound {
  std::size_t stations = 0;  ///< of all rounds so far
  ScanReach reach;           ///< how far they decide
};

/// Why `scan_until` stopped.
enum class ScanStop : std::uint8_t {
  Decided,    ///< all that has a tolerance is decided
  NotSeen,    ///< further stations do not see what lacks: another setup may
  NotHelped,  ///< further stations made the noise no smaller
  Rig,        ///< the systematic uncertainty of the rig is too large
  Rounds      ///< the most rounds that were allowed
};

/// What `scan_until` reached.
struct ScanUntil {
  std::vector<ScanRound> rounds;     ///< in their order
  ScanStop stop = ScanStop::Rounds;  ///< why no round followed
  Inspection found;                  ///< of the last round
};

/// Captures those views of a plan that were not captured before, and returns the scan with all of
/// them.
using CaptureViews = std::function<Scan(const Scan& plan)>;

/// Scans a part until a plan of inspection is decided, or says why it cannot: after each round all
/// views are reconstructed and inspected, and stations between the others are added to the same
/// setup. Rounds that an earlier session captured are not repeated.
///
/// @errors   Error(Input) as inspect_part and reconstruct; those of `capture`; Error(Cancelled)
[[nodiscard]] ScanUntil scan_until(const Scan& plan,
                                   const CaptureViews& capture,
                                   const InspectionReference& reference,
                                   const InspectionPlan& inspection,
                                   std::size_t most_rounds = 4,
                                   const Run& run = {});

/// What stopped it, and what to do, in a sentence.
[[nodiscard]] std::string text_of(ScanStop stop);

}  // namespace frangia
