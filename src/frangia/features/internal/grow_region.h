#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "frangia/features/internal/surface_cells.h"
#include "frangia/features/shape.h"

namespace frangia {

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
