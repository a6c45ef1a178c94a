#pragma once

#include <string>

#include "frangia/acquisition/measure_display.h"

namespace frangia {

/// The text of a rig.toml with what was measured of its display and camera: `white_level` of the
/// camera, `delay_s` of [devices.fringes], `exposure_step_ms` and, where frames are late,
/// `skip_frames` of [devices.camera], and [projector.response]. All else stays as it is written.
///
/// @errors   Error(Input) when a table is missing
[[nodiscard]] std::string with_display(const std::string& rig_toml,
                                       const Rig& rig,
                                       const DisplayMeasurement& measured);

}  // namespace frangia
