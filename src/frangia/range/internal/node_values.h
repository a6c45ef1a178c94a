#pragma once

#include <array>

#include <Eigen/Core>

namespace frangia {

/// Replaces missing columns, the nodes of a grid which a changed rig does not measure, by the
/// nearest known one.
///
/// @shape    nodes: any number of rows; counts[0] * counts[1] * counts[2] columns, x fastest
void fill_missing(Eigen::MatrixXd& nodes, const std::array<int, 3>& counts);

/// Replaces the rows of a matrix by the fewest rows whose sums of squares of each column agree with
/// the original ones to within 1e-4 of their mean.
[[nodiscard]] Eigen::MatrixXf principal_components(const Eigen::MatrixXd& rows);

}  // namespace frangia
