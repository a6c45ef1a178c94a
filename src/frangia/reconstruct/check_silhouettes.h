#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include <Eigen/Geometry>

#include "frangia/core/image.h"
#include "frangia/core/missing.h"
#include "frangia/core/run.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/rig/camera_model.h"

namespace frangia {

/// The part as one view saw it dark before a lit background.
struct BacklitView {
  Image<float> counts;    ///< of the frame without the projector's light
  Image<float> depth_mm;  ///< of the points that the view measured; NaN: none
  Eigen::Isometry3d rig_from_object = Eigen::Isometry3d::Identity();  ///< pose of the object
};

/// How the rims of a surface lie to the silhouettes of the part. Unlike overlap, no pose, drift or
/// rig explains a part that reaches beyond its silhouette.
struct SilhouetteReport {
  std::size_t views = 0;  ///< with a lit background
  std::size_t rims =
      0;  ///< places where a silhouette's edge and a rim of the surface were compared
  double outside_mm = kMissing;  ///< of the rims, median; below 0 they lie within the silhouettes
  double largest_mm = kMissing;  ///< the same, 99 % are below it
  double limit_mm = kMissing;    ///< half a pixel: what an edge is located to
  /// A surface that were farther out by more than this would be seen outside.
  double excluded_mm = kMissing;

  /// Whether the surface reaches beyond the silhouettes.
  [[nodiscard]] bool contradicts() const;
  /// One clause, without a full stop; empty without silhouettes.
  [[nodiscard]] std::string text() const;
};

/// Compares the rims of a surface with the silhouettes of all views whose background is lit: where
/// the measured points are dark, and what lies beside them is several times brighter.
///
/// From each place of a silhouette's edge, located between pixels at half of the light, rays go
/// inwards until one meets the surface.
///
/// @shape    `view`: called for each of `count` views of one camera in turn
/// @units    mm, object frame
/// @missing  no views and NaN where no background is lit or no rim was seen
/// @errors   Error(Input) when a view and the camera differ in size; Error(Cancelled)
[[nodiscard]] SilhouetteReport check_silhouettes(
    const RayScene& surface,
    std::size_t count,
    const std::function<BacklitView(std::size_t)>& view,
    const CameraModel& camera,
    const Run& run = {});

}  // namespace frangia
