#pragma once

#include <cstddef>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Islands, hole filling and decimation of a fused mesh.
struct FinishOptions {
  bool keep_islands = false;  ///< keep components that are too small to be told from noise
  bool watertight = false;    ///< fill all holes; new triangles are marked as synthesized
  double tolerance_mm = 0.0;  ///< decimate within this distance; 0: keep all triangles
  /// Decimate to this number of triangles, at last, as `limit_triangles`; 0: keep all.
  std::size_t max_triangles = 0;
};

/// A tetrahedron: a solid has no fewer triangles.
inline constexpr std::size_t kFewestTriangles = 4;
/// Largest limit of the number of triangles that anybody needs to state.
inline constexpr std::size_t kMostTriangles = 1'000'000'000;

/// Components that were removed from a fused mesh, because they are too small to be told from
/// noise.
struct RemovedIslands {
  std::size_t count = 0;      ///< removed components
  std::size_t triangles = 0;  ///< of them all
  double largest_mm = 0.0;    ///< diagonal of the largest bounding box
};

/// A fused mesh after its last steps.
struct FinishedMesh {
  Mesh mesh;               ///< as it is written
  RemovedIslands removed;  ///< before holes were filled
};

/// Removes islands and applies the optional last steps to a fused mesh. `run` receives a note of
/// each. An island is a component whose bounding box has a diagonal of at most a few mean edge
/// lengths, or of at most twice the median sigma of its vertices; the largest component stays.
///
/// @units    mm
/// @errors   as fill_holes and decimate; Error(Cancelled)
[[nodiscard]] FinishedMesh finish_mesh(Mesh mesh,
                                       const FinishOptions& options,
                                       const Run& run = {});

/// Decimates a mesh to at most `max_triangles`, for file formats that few programs read when they
/// hold more. `run` receives a note of the distance between the two meshes. 0 keeps all triangles.
///
/// @errors   Error(Cancelled)
[[nodiscard]] Mesh limit_triangles(const Mesh& mesh,
                                   std::size_t max_triangles,
                                   const Run& run = {});

}  // namespace frangia
