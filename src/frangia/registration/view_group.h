#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/local_fit/surfel_map.h"
#include "frangia/registration/surface_points.h"
#include "frangia/rig/camera_model.h"

namespace frangia {

/// Views with known relative poses, and the surface that they measured, in a frame of their own.
struct ViewGroup {
  /// One view of the group and its pose.
  struct Member {
    std::size_t view = 0;  ///< index into `GroupViews::maps`
    /// Pose of the view in the frame of the group.
    Eigen::Isometry3d rig_from_group = Eigen::Isometry3d::Identity();
  };
  std::vector<Member> members;  ///< views whose relative poses are fixed
  SurfacePoints points;         ///< downsampled
};

/// Surfel maps and camera that the members of all groups refer to.
struct GroupViews {
  std::span<const SurfelMap> maps;  ///< one for each view
  const FastCameraModel& model;     ///< camera of all views
};

/// A group of views with its points, about one for each cube of `spacing_mm`.
[[nodiscard]] ViewGroup make_group(std::vector<ViewGroup::Member> members,
                                   std::span<const SurfelMap> maps,
                                   double spacing_mm);

/// Spacing for the points of groups: a fiftieth of the bounding box diagonal of a group, the median
/// over all groups.
///
/// @missing  1 when no group has a point
[[nodiscard]] double spacing_for(std::span<const std::vector<ViewGroup::Member>> groups,
                                 std::span<const SurfelMap> maps);

/// Both groups as one, in the frame of `to`.
[[nodiscard]] ViewGroup join_groups(const ViewGroup& to,
                                    const ViewGroup& from,
                                    const Eigen::Isometry3d& to_from);

}  // namespace frangia
