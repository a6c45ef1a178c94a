#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <Eigen/Geometry>

#include "frangia/core/angles.h"
#include "frangia/core/run.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/rig/rig.h"

namespace frangia {

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
