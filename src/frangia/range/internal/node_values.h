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

/// The principal components of displacement fields: of three rows, x, y and z, for each change and
/// a column for each node, it makes a row for each component and three columns for each node. A
/// component mixes changes alone.
[[nodiscard]] Eigen::MatrixXf principal_displacements(const Eigen::MatrixXd& nodes);

}  // namespace frangia
