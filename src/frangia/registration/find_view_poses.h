#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/run.h"
#include "frangia/local_fit/surfel_map.h"
#include "frangia/rig/camera_model.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// Result of the search for the poses of views.
struct FoundPoses {
  std::size_t reference = 0;          ///< the view whose pose is held
  std::vector<std::size_t> left_out;  ///< views that fit no other, or in more than one pose;
                                      ///< they are emptied
  std::size_t found = 0;              ///< number of views with a pose, including the reference
  double least_overlap = 0.0;         ///< of all joins, as a share of the smaller side
  double accuracy_mm = 0.0;           ///< bound on the error of the poses

  [[nodiscard]] std::string text() const;  ///< the result as a sentence
};

/// Poses of views that were found from their shape, which the views do not have yet.
struct ProposedPoses {
  FoundPoses found;  ///< how many, and how sure
  /// By view, in the frame of the reference's present pose.
  /// @missing  none for a view that is left out
  std::vector<std::optional<Eigen::Isometry3d>> rig_from_object;
  std::vector<std::string> reasons;  ///< why a view is left out, by view; else empty
};

/// Finds the relative poses of views from their shape alone. They are starting values for
/// `register_poses`.
///
/// @shape    `maps`, `names`: one a view
/// @missing  a view that fits no other, or in more than one pose, has no pose
/// @errors   Error(Input) when no two views fit together
[[nodiscard]] ProposedPoses propose_view_poses(const ViewStore& views,
                                               std::span<const SurfelMap> maps,
                                               const CameraModel& camera,
                                               std::span<const std::string> names,
                                               const Run& run = {});

/// Sets the poses of `views` to the proposed ones.
///
/// @missing  a view without a pose is named in a warning and emptied, and so is its map
void take_view_poses(ViewStore& views,
                     std::vector<SurfelMap>& maps,
                     const ProposedPoses& proposed,
                     std::span<const std::string> names,
                     const Run& run = {});

/// Proposes poses and takes them.
///
/// @errors   Error(Input) as `propose_view_poses`
[[nodiscard]] FoundPoses find_view_poses(ViewStore& views,
                                         std::vector<SurfelMap>& maps,
                                         const CameraModel& camera,
                                         std::span<const std::string> names,
                                         const Run& run = {});

/// What the surfaces of all views say in favour of their poses and against them.
struct PoseSupport {
  std::size_t agree = 0;       ///< points on the surface that another view measured
  std::size_t violations = 0;  ///< points in front of it

  /// Points in favour. A violation outweighs three points that agree: poses at random bring some
  /// points together, too.
  [[nodiscard]] double score() const;
  /// Share of the compared points in front of a surface.
  [[nodiscard]] double contradiction() const;
};

/// Compares all views in poses that have been refined.
///
/// @shape    `rig_from_object`, `maps`: one a view
/// @missing  a view without a pose is not compared
[[nodiscard]] PoseSupport support_of_poses(
    std::span<const std::optional<Eigen::Isometry3d>> rig_from_object,
    std::span<const SurfelMap> maps,
    const CameraModel& camera);

/// Whether the poses of the views can be right to within `reach_mm`: hardly any point of one view
/// lies in front of the surface that another view measured.
[[nodiscard]] bool are_poses_plausible(const ViewStore& views,
                                       std::span<const SurfelMap> maps,
                                       const CameraModel& camera,
                                       double reach_mm);

}  // namespace frangia
