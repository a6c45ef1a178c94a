#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/local_fit/surfel_map.h"
#include "frangia/registration/surface_points.h"
#include "frangia/rig/fast_camera_model.h"

namespace frangia {

/// Views whose places among each other are known, and what they saw, in a frame of their own.
struct ViewGroup {
  struct Member {
    std::size_t view = 0;
    Eigen::Isometry3d rig_from_group = Eigen::Isometry3d::Identity();
  };
  std::vector<Member> members;
  SurfacePoints points;  ///< thinned
};

/// A group of views with its points.
///
/// shape    `spacing_mm` as that of the other groups
[[nodiscard]] ViewGroup make_group(std::vector<ViewGroup::Member> members,
                                   std::span<const SurfelMap> maps,
                                   double spacing_mm);

/// A fiftieth of the size of what the groups saw, the middle one of them.
[[nodiscard]] double spacing_for(std::span<const std::vector<ViewGroup::Member>> groups,
                                 std::span<const SurfelMap> maps);

/// What the members of all groups refer to.
struct GroupViews {
  std::span<const SurfelMap> maps;
  const FastCameraModel& model;
};

/// How one group fits onto another in one place, and which way it would fit better.
///
/// shape    a motion: three shifts, then three turns about `center_mm` of an arm of `arm_mm`
struct GroupFit {
  std::size_t agree = 0;       ///< points of either that lie on what the other saw
  std::size_t violations = 0;  ///< points of either that the other looked through
  double overlap = 0.0;        ///< share of the smaller group's points that agree
  double residual_mm = 0.0;    ///< median distance of those that agree
  double smallest_eigenvalue =
      0.0;  ///< least eigenvalue of the information of a motion, an arm as long as the
            ///< points lie far out; 0 where one slides or turns freely on the other
  Eigen::Vector3d center_mm = Eigen::Vector3d::Zero();  ///< of `from`, in the frame of `to`
  double arm_mm = 1.0;
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> gradient = Eigen::Matrix<double, 6, 1>::Zero();
  Eigen::Matrix<double, 6, 2> weakest_directions =
      Eigen::Matrix<double, 6, 2>::Zero();  ///< the two motions
                                            ///< known least

  /// `from` moved further, in the frame of `to`.
  [[nodiscard]] Eigen::Isometry3d motion(const Eigen::Matrix<double, 6, 1>& step) const;
  [[nodiscard]] double free_space_violation() const {
    return agree == 0 ? 1.0
                      : static_cast<double>(violations) / static_cast<double>(agree + violations);
  }
};

/// Compares two groups: each point is projected into the views of the other.
///
/// A point before the surface that a view saw cannot be there: the view would have seen it.
/// units    mm; a point agrees within `gate_mm` of a surface that faces the same way
[[nodiscard]] GroupFit compare_groups(const ViewGroup& to,
                                      const ViewGroup& from,
                                      const Eigen::Isometry3d& to_from,
                                      const GroupViews& views,
                                      double gate_mm);

struct GateRange {
  double widest_mm = 0.0;
  double least_mm = 0.0;
};

/// The place nearby where one group fits the other best, by Gauss-Newton with a gate that closes
/// from `gate_mm` to what the distances scatter by, but never below `least_gate_mm`.
[[nodiscard]] Eigen::Isometry3d refine_fit(const ViewGroup& to,
                                           const ViewGroup& from,
                                           Eigen::Isometry3d to_from,
                                           const GroupViews& views,
                                           const GateRange& gate);

/// Both groups as one, in the frame of `to`.
[[nodiscard]] ViewGroup join_groups(const ViewGroup& to,
                                    const ViewGroup& from,
                                    const Eigen::Isometry3d& to_from);

}  // namespace frangia
