#pragma once

#include <Eigen/Core>

#include "frangia/registration/surface_points.h"

namespace frangia {

/// Describes the neighbourhood of each point, independent of its orientation, by a fast point
/// feature histogram of the angles between normals.
///
/// @shape    33 rows, one column a point: three angles of 11 bins, each the square root of its
///          share, so that the distance between columns is the Hellinger distance
/// @missing  a column of zeros where a point has fewer than five neighbours
/// @source   FPFH: Rusu, Blodow & Beetz 2009
[[nodiscard]] Eigen::MatrixXf surface_features(const SurfacePoints& points, double radius_mm);

}  // namespace frangia
