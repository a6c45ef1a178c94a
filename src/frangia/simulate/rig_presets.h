#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "frangia/rig/rig.h"

namespace frangia {

/// The rigs that `rig_preset` knows.
[[nodiscard]] std::vector<std::string> rig_preset_names();

/// A rig by its name.
///
/// digital   a digital projector of 1280 x 800 beside a camera of 960 x 768 with a real lens
/// angular   interference fringes and a laser sheet, a camera of 512 x 512, nothing quite
/// straight carducci  the bust's set-up of the 1997 paper: 12.5 mm lens, 512 x 512 CCD, camera at
/// 490 mm and
///           projector at 1000 mm from the axis, 20 degrees between them
///
/// errors   Error(Input) that lists the names when there is no such rig
[[nodiscard]] Rig rig_preset(std::string_view name);

}  // namespace frangia
