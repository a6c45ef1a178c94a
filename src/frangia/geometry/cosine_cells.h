#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

namespace frangia {

/// A cell of the hemisphere about a normal.
struct CosineCell {
  Eigen::Vector3d center;  ///< direction of its middle, unit
  /// Directions of the middles of its edges, unit: across the rings, and along its ring.
  std::array<std::array<Eigen::Vector3d, 2>, 2> sides;
};

/// Divides the hemisphere about a unit normal into rings * sectors cells with equal integrals of
/// the cosine, pi / (rings * sectors) each: the mean over the cells of the incoming light is the
/// cosine-weighted one. `turn`, 0 to 1, turns the cells about the normal.
[[nodiscard]] std::vector<CosineCell> cosine_cells(const Eigen::Vector3d& normal,
                                                   int rings,
                                                   int sectors,
                                                   double turn);

}  // namespace frangia
