#pragma once

#include <string>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/decode/plan_decoding.h"
#include "frangia/reconstruct/reconstruct.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// What `reconstruct` does about indirect light.
enum class IndirectLightUse {
  Ignored,   ///< it is not looked for
  Counted,   ///< points stay where they are; sigma counts all of the predicted error
  Corrected  ///< points are corrected; sigma counts what may remain
};

/// What `reconstruct` does for a scan, decided before the work.
struct Capabilities {
  bool registers_views = false;        ///< refines the axis and the angles of the turntable
  bool removes_turntable_top = false;  ///< looks for the top of the turntable and removes it
  bool removes_background = false;     ///< looks for what does not turn and removes it
  IndirectLightUse indirect_light = IndirectLightUse::Ignored;  ///< see above
  /// Indirect light is looked for before the registration, too. What is not found there is not
  /// looked for again.
  bool corrects_before_registration = false;
  /// What the options ask for and this scan does not allow, with the reason: a sentence each,
  /// without a full stop.
  std::vector<std::string> left_out;
};

/// Whether what does not turn with the table is looked for and removed.
[[nodiscard]] bool removes_background(const Rig& rig, const ReconstructOptions& options);

/// Decides from the rig, the plan and the options what is done for a scan.
[[nodiscard]] Capabilities capabilities_of(const Rig& rig,
                                           const DecodePlan& plan,
                                           const ReconstructOptions& options);

/// Says once what is left out.
void report(const Capabilities& capabilities, const Run& run);

}  // namespace frangia
