#pragma once

#include <Eigen/Core>

#include "frangia/features/shape.h"

namespace frangia {

/// Whether a shape has a direction: all but a sphere.
[[nodiscard]] bool has_axis(ShapeKind kind);

/// Distance of a point from the axis, the plane or the center of a shape.
///
/// @units    mm
[[nodiscard]] double distance_between(const Shape& shape, const Eigen::Vector3d& point_mm);

/// Distance between two shapes: between planes along the normal of the datum, at the center of the
/// first; from a plane or an axis to a center or an axis; between two axes along their common
/// perpendicular; between centers.
///
/// @units    mm
[[nodiscard]] double distance_between(const Shape& shape, const Shape& datum);

}  // namespace frangia
