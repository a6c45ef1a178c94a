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

struct CompletenessOptions {
  double within_mm = 0.2;        ///< a truth point with mesh this near is covered
  std::size_t samples = 100000;  ///< spread evenly over the truth's area
  std::uint64_t seed = 1;
  double max_angle_rad = rad_from_deg(75.0);  ///< between the normal and the light or the camera
};

/// How much of the truth a mesh covers, of what could be seen at all.
struct SurfaceCompleteness {
  std::size_t count = 0;  ///< truth samples that count
  double share = 0.0;     ///< of them covered, 0 to 1
};

/// Share of the truth's area that has mesh near it.
///
/// errors   Error(Input) when the truth is empty
[[nodiscard]] SurfaceCompleteness surface_completeness(const RayScene& truth,
                                                       const RayScene& mesh,
                                                       const CompletenessOptions& options = {},
                                                       const Run& run = {});

/// The views of a scan: where the object stood in each, in the rig that saw it.
struct MeasurementViews {
  const Rig& rig;
  std::span<const Eigen::Isometry3d> rig_from_object;
};

/// The same over the part of the truth that at least one view can measure: in the camera's picture
/// and in the projector's field, hidden from neither by the truth itself, facing both.
[[nodiscard]] SurfaceCompleteness surface_completeness(const RayScene& truth,
                                                       const RayScene& mesh,
                                                       const MeasurementViews& views,
                                                       const CompletenessOptions& options = {},
                                                       const Run& run = {});

/// Whether a point of the surface, with its outward normal, can be measured in one view.
[[nodiscard]] bool is_measurable(const RayScene& scene,
                                 const Eigen::Vector3d& point_mm,
                                 const Eigen::Vector3d& normal,
                                 const MeasurementViews& view,
                                 double max_angle_rad);

}  // namespace frangia
