#pragma once

#include "frangia/pattern/pattern.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// How far a point moves across fringes of a direction, in pixels of the projector, when its depth
/// in the middle of the camera's image grows by 1 %, where the axes of camera and projector come
/// nearest. Fringes without parallax do not measure depth.
///
/// @units    px
/// @missing  0 for an angular projector, a label, and a projector at the place of the camera
[[nodiscard]] double fringe_parallax_px(const Rig& rig, FringeDirection direction);

/// The direction of fringes that measures depth better: horizontal for a projector above or below
/// the camera, vertical for one beside it and for an angular projector.
[[nodiscard]] FringeDirection measuring_direction(const Rig& rig);

/// Whether fringes of a direction measure next to nothing, while those of the other would: their
/// parallax is less than a twentieth.
[[nodiscard]] bool lacks_parallax(const Rig& rig, FringeDirection direction);

}  // namespace frangia
