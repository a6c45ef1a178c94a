#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/missing.h"

namespace frangia {

/// How one setup of a scan was joined with the others.
struct SetupJoin {
  int number = 0;          ///< in scan.toml
  std::size_t views = 0;   ///< with points
  bool joined = false;     ///< false: it is not part of the mesh
  bool ambiguous = false;  ///< it fits in more than one pose
  /// Pose of the part relative to the first joined setup, both at angle 0, object frame, mm.
  Eigen::Isometry3d part_pose = Eigen::Isometry3d::Identity();
  /// Share of the points of the smaller of this setup and the first joined one that lie on the
  /// other's surface; NaN for the first one and for one that is not joined.
  double overlap = kMissing;
  /// Share of the compared points in front of what the other setup measured; NaN as `overlap`.
  double free_space_violation = kMissing;
  /// Motions of the setup that the surfaces do not decide, one sentence each; they are in sigma.
  std::vector<std::string> open{};
};

}  // namespace frangia
