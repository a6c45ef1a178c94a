#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/registration/point_tie.h"
#include "frangia/rig/target_set.h"
#include "frangia/targets/target_sighting.h"

namespace frangia {

/// What a view saw of targets, and where it is.
struct TargetView {
  std::string name;                       ///< for messages
  std::vector<TargetSighting> sightings;  ///< as find_targets returns them
  Eigen::Isometry3d rig_from_object = Eigen::Isometry3d::Identity();  ///< pose of the object
};

/// A target that views of one setup saw.
///
/// @units    mm, object frame
struct Target {
  /// A view, and the number of its sighting of the target.
  struct Sighting {
    std::size_t view = 0;   ///< index of the view
    std::size_t index = 0;  ///< of the sighting in the view
  };
  int code = -1;                                             ///< -1: it has none
  Eigen::Vector3d center_mm = Eigen::Vector3d::Zero();       ///< weighted mean of the sightings
  Eigen::Matrix3d covariance_mm2 = Eigen::Matrix3d::Zero();  ///< of `center_mm`
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();          ///< unit, outwards
  std::vector<Sighting> seen;  ///< by ascending view, at most one a view
};

/// Collects the sightings of views whose places are known to a millimetre or so. Uncoded targets
/// are those whose sightings are nearer to each other than two stickers can be.
///
/// @errors   Error(Input) when two targets of the setup have one code
[[nodiscard]] std::vector<Target> match_targets(std::span<const TargetView> views,
                                                const TargetSet& targets);

/// The motion that brings the targets of one setup onto those of another.
struct TargetJoin {
  /// A target of the one setup and the same target in the other.
  struct Pair {
    std::size_t to = 0;    ///< index in the one setup
    std::size_t from = 0;  ///< index in the other
  };
  Eigen::Isometry3d to_from = Eigen::Isometry3d::Identity();  ///< the motion
  std::vector<Pair> pairs;  ///< of the targets that it brings together
  double rms_mm = 0.0;      ///< of the distances of the pairs
  std::size_t second = 0;   ///< pairs of the best motion that is another one
  /// Whether another motion brings as many targets together, such as by the symmetry of their
  /// places.
  [[nodiscard]] bool ambiguous() const { return second >= pairs.size(); }
};

/// Finds the motion by the codes, and by the distances of uncoded targets from each other: the one
/// that brings most of them together with alike normals.
///
/// @missing  none when fewer than three targets that are not on a line, or four uncoded ones, match
[[nodiscard]] std::optional<TargetJoin> join_targets(std::span<const Target> to,
                                                     std::span<const Target> from,
                                                     const TargetSet& targets);

/// The pairs of views that saw one target, for all targets.
[[nodiscard]] std::vector<PointTie> ties_of(std::span<const Target> targets,
                                            std::span<const TargetView> views);

}  // namespace frangia
