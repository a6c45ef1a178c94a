#pragma once

#include <vector>

#include "frangia/core/pixel_allocator.h"
#include "frangia/fusion/fusion_parameters.h"
#include "frangia/fusion/internal/edge_crossings.h"
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

}  // namespace frangia
