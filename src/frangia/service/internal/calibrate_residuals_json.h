#pragma once

#include <string>

#include "frangia/calibrate/solve/calibrate_rig.h"

namespace frangia {

/// The residuals of a calibration by pose and over the images, as docs/service-api.md describes
/// them. Maps of more than 4000 points are thinned.
[[nodiscard]] std::string residuals_text(const RigCalibration& result);

}  // namespace frangia
