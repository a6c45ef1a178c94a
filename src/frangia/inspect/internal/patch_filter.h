#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "frangia/geometry/ray_scene.h"
#include "frangia/inspect/deviation.h"
#include "frangia/inspect/internal/edge_strips.h"
#include "frangia/inspect/internal/patch_grid.h"
#include "frangia/inspect/surface_patches.h"

namespace frangia::inspect {

/// Cosine between the normals of one face, at least.
inline constexpr float kSameFace = 0.3F;

/// What was measured in a patch, mm.
struct PatchMean {
  double deviation_mm = 0.0;
  double noise_mm = 0.0;      ///< of independent vertices
  double one_point_mm = 0.0;  ///< noise of a point: the most that points which err alike have
  double place_mm = 0.0;      ///< noise that points of this place share
  double systematic_mm = 0.0;
  double scatter_mm2 = 0.0;  ///< weighted mean square of the differences of the points from it
  double point_share = 1.0;  ///< sum of the squares of the weights, whose sum is 1: 1 / points
};

/// The standard uncertainty of a point, in parts that average differently, mm.
struct PointSigma {
  double noise_mm = 0.0;       ///< differs from point to point
  double place_mm = 0.0;       ///< noise beyond that of most vertices: neighbors share it
  double systematic_mm = 0.0;  ///< alike over the part
};

/// The measured points in each patch: vertices, and parts of triangles that are larger than a
/// patch.
///
/// Parts are compared by their own distance from the reference, so that the faces of a decimated
/// mesh are measured between their corners, which lie at edges.
class PatchFilter {
 public:
  /// Collects the points of a mesh. `grid` holds the centers of the patches. Points in strips along
  /// edges count for the patches there alone.
  PatchFilter(const Mesh& mesh,
              const Deviations& deviations,
              const RayScene& reference,
              const PatchGrid& grid,
              const SurfacePatches& patches,
              const EdgeStrips& strips,
              const Run& run);

  /// Mean over the well measured points of a patch, and their area, mm2. A point that is less
  /// certain than the median of the patch counts by the square of the ratio, also in the area:
  /// beside others, it says little about the patch. Without points all is NaN, and the area 0.
  [[nodiscard]] std::pair<PatchMean, double> average(std::size_t patch) const;

 private:
  /// A measured point.
  struct Point {
    double deviation_mm = 0.0;
    PointSigma sigma;
  };
  friend class PointFinder;

  std::vector<Point> points_;
  std::vector<std::vector<std::pair<std::uint32_t, double>>> points_of_;  ///< with their areas
};

}  // namespace frangia::inspect
