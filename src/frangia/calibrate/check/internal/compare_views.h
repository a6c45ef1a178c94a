#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// The sites of one camera at which a part is compared.
struct SiteGrid {
  int step = 1;
  int columns = 0;
  int rows = 0;

  [[nodiscard]] std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
};

/// The grid of points of one view of one camera, and what is needed to compare another with it.
struct PartView {
  SiteGrid grid;
  CameraModel camera;
  std::vector<Eigen::Vector3d> points;  ///< by site, in the frame of the camera; NaN where missing
  Eigen::Isometry3d camera_from_zero =
      Eigen::Isometry3d::Identity();  ///< from the rig frame, with the table at angle 0
};

/// Measures one view of a part. `scan` and its rig are those of one camera, see `scan_of_camera`.
[[nodiscard]] PartView measure_part_view(const Scan& scan,
                                         std::size_t view,
                                         int part_sites,
                                         const Run& run);

/// Distances between the surfaces of two views, averaged over patches.
struct PatchDistances {
  std::vector<double> mean_mm;   ///< signed, along the normal
  std::vector<double> sigma_mm;  ///< standard deviation of the mean
};

/// Distances of the points of one view from the surface of another, along its normals. Averaging
/// over patches of 8 x 8 sites reduces the noise and leaves what is wrong with the rig.
///
/// @units    mm
void compare_views(const PartView& from,
                   const PartView& to,
                   double match_share,
                   PatchDistances& out);

}  // namespace frangia
