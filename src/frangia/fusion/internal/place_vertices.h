#pragma once

#include <vector>

#include "frangia/core/pixel_allocator.h"
#include "frangia/fusion/internal/edge_crossings.h"
#include "frangia/fusion/internal/hermite_accumulators.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Vertices with normals, sigma and views; no triangles yet.
struct PlacedVertices {
  Mesh mesh;
  LargeVector<Eigen::Vector3f> in_cell_mm;  ///< where each would be if it had to stay in its cell
  std::vector<std::uint8_t> sharp;          ///< 1 for a vertex on an edge or a corner of the object
};

/// One vertex for each loop of each cell, where the planes through the loop's crossings meet.
///
/// Planes that agree are averaged, planes that meet in an edge or a corner put the vertex there:
/// directions in which they say less than noise does are left at their middle. A vertex may leave
/// its cell by half a voxel, since an edge of the object can run where the grid has no crossing.
/// shape    `crossings.vertices` vertices
/// missing  a vertex none of whose crossings holds is zero
/// source   dual contouring, Ju et al. 2002; several vertices a cell, Schaefer et al. 2007
[[nodiscard]] PlacedVertices place_vertices(const EdgeCrossings& crossings,
                                            const HermiteAccumulators& hermite);

}  // namespace frangia
