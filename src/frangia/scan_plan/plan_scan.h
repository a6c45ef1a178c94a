#pragma once

#include <string>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/inspect/uncertainty_map.h"
#include "frangia/inspection/inspect_part.h"
#include "frangia/inspection/inspection_plan.h"
#include "frangia/inspection/inspection_reference.h"
#include "frangia/rig/rig.h"
#include "frangia/scan_plan/scan_need.h"
#include "frangia/scan_plan/scan_recipe.h"
#include "frangia/scan_plan/virtual_scan.h"

namespace frangia {

/// How a scan is planned.
struct ScanPlanOptions {
  VirtualScanOptions scan;  ///< `divisor` 0: one by which a camera has about 240 pixels a row
  ScanRecipe start;         ///< where the search begins
  int most_stations = 36;   ///< of a setup
  bool search = true;       ///< false: `start` alone is predicted
};

/// A recipe that was tried, and what it reaches.
struct TriedRecipe {
  ScanRecipe recipe;  ///< what was tried
  ScanReach reach;    ///< how far it decides
  std::string fault;  ///< why there was nothing to inspect; empty: there was
};

/// How a part is to be scanned so that a plan of inspection can decide, and what that reaches.
struct ScanPlan {
  ScanRecipe recipe;                  ///< the cheapest one that was found to reach most
  std::vector<TriedRecipe> tried;     ///< in their order, `recipe` among them
  bool suffices = false;              ///< a part without errors would be in by `recipe`
  ScanNeed need = ScanNeed::Nothing;  ///< what `recipe` lacks
  Inspection predicted;               ///< of a part without errors
  std::vector<DecidableCharacteristic> characteristics;  ///< those with a tolerance
  UncertaintyMap map;                                    ///< predicted U95; NaN: nothing sees it
};

/// Plans the scan of a part: scans it in software (`virtual_scan`), inspects what was measured by
/// the plan of inspection, and adds setups, stations, exposures, finer fringes and frames as far as
/// they help, until all that has a tolerance is decided.
///
/// The part has no errors, so that what is undecided is not measured well enough. Whether the
/// setups of a part that looks alike when turned over can be told apart is not part of the
/// prediction.
/// @errors   Error(Input) as inspect_part and virtual_scan, where also the first recipe sees too
///           little; Error(Cancelled)
[[nodiscard]] ScanPlan plan_scan(const InspectionReference& reference,
                                 const InspectionPlan& plan,
                                 const Rig& rig,
                                 const ScanPlanOptions& options = {},
                                 const Run& run = {});

}  // namespace frangia
