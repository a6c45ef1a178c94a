#pragma once

#include <optional>

#include "frangia/rig/rig.h"

namespace frangia {

/// The figures of a rig's geometry that a person sets by hand.
struct RigArrangement {
  std::optional<double> baseline_mm;      ///< camera to projector, along the present direction
  std::optional<double> distance_mm;      ///< camera to the turntable's axis, along its direction
  std::optional<double> camera_focal_px;  ///< along x; y keeps its ratio
  std::optional<double> projector_focal_px;  ///< of a digital projector, likewise
};

/// Moves the parts of a rig. The projector turns so that the point of the turntable at which it
/// aimed stays where it was in its field. A rig that changes is no longer calibrated.
///
/// @units    mm, px
/// @errors   Error(Input) that names the value which is not above 0, or that the rig does not have
[[nodiscard]] Rig arrange_rig(Rig rig, const RigArrangement& wanted);

}  // namespace frangia
