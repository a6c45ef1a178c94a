#pragma once

#include <Eigen/Core>

#include "frangia/registration/surface_points.h"

namespace frangia {

/// What a surface looks like around each of its points, however it is turned: a fast point feature
/// histogram of the angles between a point's normal and those of its neighbours.
///
/// shape    33 rows, a column a point: three angles of 11 bins, the root of each bin's share, so
///          that distances between columns are those of Hellinger
/// missing  a column of zeros where a point has fewer than five neighbours
/// source   FPFH: Rusu, Blodow & Beetz 2009
[[nodiscard]] Eigen::MatrixXf surface_features(const SurfacePoints& points, double radius_mm);

}  // namespace frangia
