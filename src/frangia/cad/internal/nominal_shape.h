#pragma once

#include <optional>

#include <Eigen/Core>

#include "frangia/cad/internal/occt_foot.h"
#include "frangia/features/shape.h"

namespace frangia {

/// The nominal shape of a face: a plane, cylinder, cone, sphere or torus, also one that is stated
/// as a line or circle swept along or about an axis, as IGES does.
///
/// @param side  -1 where outward is against the normal of the parametrization
/// @param amid  a point amid the face, mm; the center of an unbounded shape is moved beside it
/// @missing     none where the surface is of another kind
[[nodiscard]] std::optional<Shape> nominal_shape(const FootSurface& surface,
                                                 double side,
                                                 const Eigen::Vector3d& amid);

}  // namespace frangia
