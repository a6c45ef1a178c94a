#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/features/feature_points.h"
#include "frangia/features/shape.h"

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

/// Connected cells that lie on a shape.
struct ShapeRegion {
  Shape shape;
  double side = 1.0;    ///< 1 where the surface's normals are those of the shape, -1 inside a hole
  double rms_mm = 0.0;  ///< of the cells' distances
  std::vector<std::uint32_t> cells;  ///< ascending
};

/// When a cell lies on a shape.
struct GrowLimits {
  double gate_mm = 0.0;                ///< largest distance
  double least_normal_cosine = 0.966;  ///< between the normals of cell and shape: 15 degrees
};

/// Grows regions. An object serves one thread: it keeps a mark for each cell.
class RegionGrower {
 public:
  RegionGrower(const SurfaceCells& cells, const FeaturePoints& cell_points);

  /// Cells around a seed across smooth neighbours, in breadth-first order, up to `count`.
  [[nodiscard]] std::vector<std::uint32_t> patch(std::uint32_t seed,
                                                 std::size_t count,
                                                 std::span<const std::uint8_t> available);

  /// The available cells that lie on the shape of `start` and connect to its cells that do. With
  /// `largest_only`, the largest connected set of them.
  [[nodiscard]] ShapeRegion grow(const ShapeRegion& start,
                                 const GrowLimits& limits,
                                 std::span<const std::uint8_t> available,
                                 bool largest_only = false);

  /// Grows and fits in turn until the region stays.
  [[nodiscard]] ShapeRegion settle(ShapeRegion region,
                                   const GrowLimits& limits,
                                   std::span<const std::uint8_t> available);

 private:
  [[nodiscard]] bool lies_on(std::uint32_t cell,
                             const ShapeRegion& region,
                             const GrowLimits& limits) const;

  const SurfaceCells& cells_;
  const FeaturePoints& cell_points_;
  std::vector<std::uint32_t> marks_;
  std::uint32_t mark_ = 0;
};

/// At most `most` of the cells, evenly spread over their numbers.
[[nodiscard]] std::vector<std::uint32_t> thinned(const std::vector<std::uint32_t>& cells,
                                                 std::size_t most);

/// 1 or -1: whether the normals of the cells are those of the shape.
[[nodiscard]] double side_of(const Shape& shape,
                             const SurfaceCells& cells,
                             std::span<const std::uint32_t> chosen);

}  // namespace frangia
