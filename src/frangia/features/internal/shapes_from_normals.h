#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "frangia/features/feature_points.h"
#include "frangia/features/shape.h"

namespace frangia {

/// Shapes that a patch of points with normals suggests: at most one of each kind of surface, in
/// the order of their numbers of parameters. They are starting values of a fit.
///
/// @source   axes from normals: Pottmann & Wallner 2001, Computational Line Geometry
[[nodiscard]] std::vector<Shape> shapes_from_normals(std::span<const Eigen::Vector3d> points_mm,
                                                     std::span<const Eigen::Vector3d> normals);

}  // namespace frangia
