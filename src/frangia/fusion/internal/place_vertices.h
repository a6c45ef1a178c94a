#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/pixel_buffer.h"
#include "frangia/fusion/fusion_parameters.h"
#include "frangia/fusion/internal/cell_loops.h"
#include "frangia/fusion/internal/hermite_accumulators.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Vertices with normals, sigma and views, but without triangles. `sigma_mm` is the noise until
/// `fuse_views` combines it with the systematic part, where one is known.
struct PlacedVertices {
  Mesh mesh;
  LargeVector<Eigen::Vector3f> in_cell_mm;  ///< position of each vertex confined to its cell
  std::vector<std::uint8_t> sharp;          ///< 1 for a vertex on an edge or corner of the object
  std::vector<float> bend_mm;               ///< part of sigma: the surface may bend within the cell
};

/// Places one vertex for each loop of each cell where the planes at the loop's crossings intersect.
///
/// Parallel planes are averaged. Planes of several faces put the vertex on their edge or corner. A
/// vertex may leave its cell by half a voxel, since an edge of the object can run where the grid
/// has no crossing. The systematic part of a vertex is the mean of those at its crossings.
///
/// @shape    `crossings.vertices` vertices
/// @missing  a vertex without a supported crossing is zero
/// @source   dual contouring: Ju et al. 2002; several vertices in a cell: Schaefer et al. 2007
[[nodiscard]] PlacedVertices place_vertices(const EdgeCrossings& crossings,
                                            const HermiteAccumulators& hermite,
                                            const FusionParameters& parameters = {});

/// A grid cell, or one grown by `margin_mm` on every side.
struct CellBox {
  CellBox(const Eigen::Vector3f& low_mm, float edge_mm, float margin_mm)
      : low(low_mm.array() - margin_mm), high(low_mm.array() + edge_mm + margin_mm) {}

  [[nodiscard]] bool contains(const Eigen::Vector3f& point) const {
    return (point.array() >= low).all() && (point.array() <= high).all();
  }
  Eigen::Array3f low;
  Eigen::Array3f high;
};

/// The supported samples around one loop of a cell. They determine one vertex.
struct LoopSamples {
  std::array<const HermiteSample*, 12> samples;  ///< the first `count` are set
  std::array<HermiteSample, 12> lesser;          ///< samples of second faces
  std::size_t count = 0;
  std::size_t lesser_count = 0;
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< sum; after `close` the unit mean
  Eigen::Vector3f middle = Eigen::Vector3f::Zero();  ///< sum; after `close` the mean point
  float systematic_mm = 0.0F;  ///< sum over the samples; stays 0 where no systematic part is known

  void add(const HermiteSample& sample) {
    samples[count++] = &sample;
    normal += sample.normal;
    middle += sample.point;
  }
  void close() {
    normal.normalize();
    middle /= static_cast<float>(count);
  }
  [[nodiscard]] std::span<const HermiteSample* const> all() const {
    return std::span(samples).first(count);
  }
};

/// Whether all planes are within an angle of their mean, given by its cosine.
[[nodiscard]] bool is_flat(const LoopSamples& loop, float parallel_cosine);

/// Returns the point that minimizes the quadratic error function of the planes within a cell.
///
/// With second faces the minimum over all planes comes first. Parallel planes are averaged.
/// Otherwise directions with an eigenvalue below `min_eigenvalue` of the largest, and then further
/// ones, are left at the mean point until the minimum lies in the cell.
/// @source   Ju et al. 2002; truncated eigenvalues: Kobbelt et al. 2001
[[nodiscard]] Eigen::Vector3f solve_position(const LoopSamples& loop,
                                             bool flat,
                                             float min_eigenvalue,
                                             const CellBox& cell);

}  // namespace frangia
