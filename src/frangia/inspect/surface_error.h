#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/angles.h"
#include "frangia/core/run.h"
#include "frangia/geometry/exact_surface.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// Sampling and distance limit of a comparison with a reference.
struct SurfaceErrorOptions {
  std::size_t samples = 0;  ///< points distributed evenly over the area; 0: the vertices
  std::uint64_t seed = 1;   ///< of the samples
  /// Points beyond it count as outliers in share_beyond; all other statistics but rms_within_mm
  /// include them.
  double max_distance_mm = std::numeric_limits<double>::infinity();
  /// Surface that the reference approximates, such as a CAD model; null: the reference is exact.
  const ExactSurface* exact = nullptr;
};

/// Statistics of the distances of a mesh from a reference. All but `bias_mm` are of absolute
/// distances.
struct SurfaceError {
  std::size_t count = 0;       ///< number of compared points
  double rms_mm = 0.0;         ///< root mean square distance
  double mean_mm = 0.0;        ///< mean distance
  double bias_mm = 0.0;        ///< mean of the signed distances, positive outside the reference
  double p95_mm = 0.0;         ///< 95th percentile of the distances
  double p99_mm = 0.0;         ///< 99th percentile of the distances
  double max_mm = 0.0;         ///< largest distance
  double rms_within_mm = 0.0;  ///< of the points within max_distance_mm
  double share_beyond = 0.0;   ///< of the points farther than max_distance_mm, 0 to 1
};

/// Measures the distances from a mesh to the nearest points of a reference, without trimming.
///
/// @units    mm
/// @missing  vertices without a triangle do not count
/// @errors   Error(Input) when either mesh has no triangles
[[nodiscard]] SurfaceError surface_error(const Mesh& mesh,
                                         const RayScene& reference,
                                         const SurfaceErrorOptions& options = {},
                                         const Run& run = {});

/// The signed distance of each vertex from a reference, positive outside. `exact` is the surface
/// that the reference approximates; null: the reference is exact.
///
/// @units    mm
/// @errors   Error(Input) when the reference has no triangles
[[nodiscard]] std::vector<float> vertex_errors_mm(const Mesh& mesh,
                                                  const RayScene& reference,
                                                  const Run& run = {},
                                                  const ExactSurface* exact = nullptr);

/// Sampling and distance limit of a measurement of completeness.
struct CompletenessOptions {
  double within_mm = 0.2;        ///< a reference point with mesh within this distance is covered
  std::size_t samples = 100000;  ///< distributed evenly over the area of the reference
  std::uint64_t seed = 1;        ///< of the samples' random positions
  double max_angle_rad =
      rad_from_deg(75.0);  ///< between the normal and the direction to the projector or the camera
};

/// Share of a reference surface that a mesh covers.
struct SurfaceCompleteness {
  std::size_t count = 0;  ///< reference samples that count
  double share = 0.0;     ///< share of them that is covered, 0 to 1
};

/// Share of the reference's area with mesh within `within_mm`.
///
/// @units    mm
/// @errors   Error(Input) when the reference has no triangles
[[nodiscard]] SurfaceCompleteness surface_completeness(const RayScene& reference,
                                                       const RayScene& mesh,
                                                       const CompletenessOptions& options = {},
                                                       const Run& run = {});

/// The views of a scan: the rig and the pose of the object in each view.
struct MeasurementViews {
  const Rig& rig;                                      ///< calibration of camera and projector
  std::span<const Eigen::Isometry3d> rig_from_object;  ///< pose of the object in each view
};

/// Completeness of the part of the reference that at least one view can measure: inside the fields
/// of a camera and the projector, occluded from neither by the reference itself, and facing both. A
/// projector that is a label counts as lighting everything, and two cameras are needed.
[[nodiscard]] SurfaceCompleteness surface_completeness(const RayScene& reference,
                                                       const RayScene& mesh,
                                                       const MeasurementViews& views,
                                                       const CompletenessOptions& options = {},
                                                       const Run& run = {});

/// Whether a point of the surface, with its outward normal, can be measured in at least one view.
[[nodiscard]] bool is_measurable(const RayScene& scene,
                                 const Eigen::Vector3d& point_mm,
                                 const Eigen::Vector3d& normal,
                                 const MeasurementViews& view,
                                 double max_angle_rad);

}  // namespace frangia
