#pragma once

#include <Eigen/Core>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// A rectangular sheet about the origin. Its face lies in z = 0 and faces -z; its body of 3 mm lies
/// at z > 0.
///
/// @units    mm; `half` holds half of the sides along x and y
[[nodiscard]] Mesh make_sheet(const Eigen::Vector2d& half);

}  // namespace frangia
