#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "frangia/rig/rig.h"

namespace frangia {

/// Names of the built-in rigs.
[[nodiscard]] std::vector<std::string> rig_preset_names();

/// Returns a built-in rig.
///
/// digital    digital projector of 1280 x 800, camera of 960 x 768 with lens distortion
/// binocular  the same with a second camera, "left", on the other side of the projector
/// angular    interference fringes and a laser sheet, camera of 512 x 512, tilted turntable
/// carducci   set-up for the bust in the 1997 paper: 12.5 mm lens, CCD of 512 x 512, camera at
///            490 mm and projector at 1000 mm from the axis, 20 degrees between them
///
/// @errors   Error(Input) that lists the names for an unknown name
[[nodiscard]] Rig rig_preset(std::string_view name);

}  // namespace frangia
