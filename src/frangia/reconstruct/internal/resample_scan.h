#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/files/range_scan.h"
#include "frangia/reconstruct/merge_scans.h"
#include "frangia/rig/camera_model.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// The camera on whose pixel grid a range scan is resampled. It looks against the scan's mean
/// normal.
///
/// @units    mm
struct VirtualCamera {
  Eigen::Isometry3d rig_from_scan = Eigen::Isometry3d::Identity();
  double radius_mm = 0.0;   ///< half the diagonal of the scan's bounding box
  double spacing_mm = 0.0;  ///< median distance of neighbouring points
};

/// Returns the virtual camera of one scan, at its centre until `common_camera_model` sets the
/// distance.
///
/// @errors   Error(Input) that names the file when the scan has fewer than 3 points, when its
///          points coincide or one of them is too far away, or when its pose is too far away
[[nodiscard]] VirtualCamera virtual_camera_of(const RangeScan& scan);

/// Returns one camera model for all scans and moves the cameras to their distance. The field holds
/// the largest scan; the pixel pitch on the part is the spacing of the densest.
[[nodiscard]] CameraModel common_camera_model(std::vector<VirtualCamera>& cameras,
                                              bool points_only);

/// A range scan as a view of the common camera.
struct ResampledScan {
  View view;
  std::size_t points = 0;  ///< pixels with a depth
  double noise_mm = 0.0;   ///< standard deviation of the depth, from the scatter of neighbours
  DroppedPoints dropped;   ///< points of the scan that no pixel stands for
};

/// Resamples a scan on the pixel grid of the common camera.
///
/// @missing  NaN where the camera sees no surface of the scan
[[nodiscard]] ResampledScan resample_scan(const RangeScan& scan,
                                          const VirtualCamera& camera,
                                          const CameraModel& model);

}  // namespace frangia
