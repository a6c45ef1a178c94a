#pragma once

#include <cstddef>
#include <limits>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

struct DecimateOptions {
  std::size_t triangles = 0;  ///< stop at so many
  /// The two surfaces lie nowhere farther from each other than this, either way.
  double tolerance_mm = std::numeric_limits<double>::infinity();
};

/// Fewer triangles for the same surface: edges are joined in the order of the error that it makes.
///
/// Edges of the part stay sharp, boundaries stay, a mesh that is manifold stays so, and no triangle
/// turns over. Vertices that were measured well weigh more than ones with a large sigma. A vertex
/// keeps the larger sigma, the fewer views and the worse mark of those it stands for.
///
/// With a tolerance every join is checked to four fifths of it, both surfaces against each other,
/// at their vertices, the middles of their edges and triangles, and on large triangles at points
/// half as far apart as the mesh's edges were long.
/// errors   Error(Input) for a tolerance that is not positive
/// source   Garland & Heckbert 1997, Surface Simplification Using Quadric Error Metrics
[[nodiscard]] Mesh decimate(Mesh mesh, const DecimateOptions& options, const Run& run = {});

}  // namespace frangia
