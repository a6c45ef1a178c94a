#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "frangia/dataset/scan_folder.h"

namespace frangia::inspection {

/// The pose of the part in each view of a scan, in the frame of its mesh, which is that of setup 0:
/// rig_from_mesh.
[[nodiscard]] inline std::vector<Eigen::Isometry3d> view_poses(const Scan& scan) {
  std::vector<Eigen::Isometry3d> poses;
  for (const ScanView& view : scan.views) {
    Eigen::Isometry3d pose = scan.rig.rig_from_object(view.angle_rad);
    if (const auto placed = scan.part_poses.find(view.setup); placed != scan.part_poses.end())
      pose = pose * placed->second;
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace frangia::inspection
