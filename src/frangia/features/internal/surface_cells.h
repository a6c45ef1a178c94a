#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/features/feature_points.h"

namespace frangia {

/// Points of a surface, gathered into the cells of a grid, and the neighbours of each cell. The
/// search for shapes works on cells; only the last fit of a shape uses all points.
///
/// Points whose normals point along different coordinate axes are in different cells, so that the
/// two sides of a thin wall, and of a sharp edge, stay apart.
struct SurfaceCells {
  double edge_mm = 0.0;                      ///< of the cells of the grid
  std::vector<Eigen::Vector3d> points_mm;    ///< of each cell, the point nearest to their mean
  std::vector<Eigen::Vector3d> normals;      ///< unit mean of the points' normals
  std::vector<std::uint32_t> first_point;    ///< where the points of a cell begin; one more at end
  std::vector<std::uint32_t> point_numbers;  ///< the points of all cells, cell by cell
  std::vector<std::uint32_t> first_neighbor;
  std::vector<std::uint32_t> neighbors;  ///< cells that touch in the grid, with similar normals

  [[nodiscard]] std::size_t size() const { return points_mm.size(); }
  [[nodiscard]] std::span<const std::uint32_t> neighbors_of(std::uint32_t cell) const {
    return {neighbors.data() + first_neighbor[cell], neighbors.data() + first_neighbor[cell + 1]};
  }
  [[nodiscard]] std::span<const std::uint32_t> points_of(std::uint32_t cell) const {
    return {point_numbers.data() + first_point[cell], point_numbers.data() + first_point[cell + 1]};
  }
};

/// Gathers points into about `count` cells.
[[nodiscard]] SurfaceCells surface_cells(const FeaturePoints& points,
                                         std::size_t count,
                                         const Run& run = {});

}  // namespace frangia
