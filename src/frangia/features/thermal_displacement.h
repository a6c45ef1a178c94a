#pragma once

#include <Eigen/Core>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// How an error of the part's temperature, of one standard uncertainty, displaces the vertices of
/// its mesh along their normals: it scales the part about its middle. It is a further row of
/// `FeaturePoints::calibration_mm`.
///
/// @shape    one row, a column for each vertex
/// @units    mm; 1/K; K
[[nodiscard]] Eigen::MatrixXf thermal_displacement(const Mesh& mesh,
                                                   double expansion_per_k,
                                                   double temperature_u_k);

}  // namespace frangia
