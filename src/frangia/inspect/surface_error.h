#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/ray_scene.h"

namespace frangia {

struct SurfaceErrorOptions {
  std::size_t samples = 0;  ///< points spread evenly over the area; 0 takes the vertices
  std::uint64_t seed = 1;   ///< of the samples
  /// Farther points are not the part but something else; they are counted apart, never hidden.
  double max_distance_mm = std::numeric_limits<double>::infinity();
};

/// How far a mesh lies from the truth. Distances without sign, but for `bias_mm`.
struct SurfaceError {
  std::size_t count = 0;
  double rms_mm = 0.0;
  double mean_mm = 0.0;
  double bias_mm = 0.0;  ///< mean of the signed distances, positive outside the truth
  double p95_mm = 0.0;
  double p99_mm = 0.0;
  double max_mm = 0.0;
  double rms_within_mm = 0.0;  ///< of the points within max_distance_mm
  double share_beyond = 0.0;   ///< of the points farther than max_distance_mm, 0 to 1
};

/// Distances from a mesh to the truth; every point counts, none is trimmed.
///
/// missing  vertices without a triangle are not surface and do not count
/// errors   Error(Input) when either mesh is empty
[[nodiscard]] SurfaceError surface_error(const Mesh& mesh,
                                         const RayScene& truth,
                                         const SurfaceErrorOptions& options = {},
                                         const Run& run = {});

/// The signed distance of each vertex, positive outside the truth: what a colour map shows.
[[nodiscard]] std::vector<float> vertex_errors_mm(const Mesh& mesh,
                                                  const RayScene& truth,
                                                  const Run& run = {});

}  // namespace frangia
