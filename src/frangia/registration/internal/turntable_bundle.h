#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/local_fit/surfel_map.h"
#include "frangia/rig/fast_camera_model.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// What moves when views are registered: the axis, the angle of each view, and how the part stands
/// in each setup but the first.
struct TableState {
  Turntable table;
  std::vector<double> angles_rad;
  std::vector<std::size_t> setups;  ///< of each view; empty: all in the first
  std::vector<Eigen::Isometry3d>
      part_poses{};  ///< of each further setup: what takes the part from its
                     ///< place in the first, both at angle 0, rig frame

  [[nodiscard]] std::size_t setup_of(std::size_t view) const {
    return setups.empty() ? 0 : setups[view];
  }
  [[nodiscard]] Eigen::Isometry3d part_pose(std::size_t setup) const {
    return setup == 0 ? Eigen::Isometry3d::Identity() : part_poses[setup - 1];
  }
  [[nodiscard]] Eigen::Index unknowns() const {
    return static_cast<Eigen::Index>(angles_rad.size() + 3 + 6 * part_poses.size());
  }
  /// Where the unknowns of a further setup begin.
  [[nodiscard]] Eigen::Index index_of_setup(std::size_t setup) const {
    return static_cast<Eigen::Index>(angles_rad.size() + 3 + 6 * (setup - 1));
  }
  /// The view whose turn closes with that of the first: the last of the first setup.
  [[nodiscard]] std::size_t closing_view() const;
};

/// What another view says to the surfels of one.
struct PairTally {
  std::size_t agree = 0;       ///< lie on what it saw
  std::size_t violations = 0;  ///< lie before what it saw, where it would have seen them
};

/// How the views fit together in one state, and which way to go: the normal equations of all
/// point-to- plane distances between views.
///
/// shape    unknowns: two tilts of the axis and two shifts, about and along `across`; then the
/// angles of
///          views 1, 2, ...; view 0 is held; then three shifts and three turns of each further
///          setup's part pose, about the table's point
/// units    rad, mm
struct BundleSums {
  Eigen::MatrixXd hessian;
  Eigen::VectorXd gradient;
  double squares = 0.0;         ///< sum of w r^2
  double closing_weight = 0.0;  ///< sum of w s^2 of the pairs of the closing view and the first, s
                                ///< the slope by the last one's angle
  double closing_gradient = 0.0;    ///< sum of w s r of them
  std::vector<float> distances_mm;  ///< of all pairs, without sign
  std::vector<std::size_t>
      matched;  ///< by view: its surfels that lie on a surface another view saw
  std::vector<std::size_t> observed;  ///< by view: its surfels that another view looked at
  std::vector<PairTally> pairs;       ///< by view and other view, row by row

  [[nodiscard]] const PairTally& pair(std::size_t from, std::size_t to) const {
    return pairs[from * matched.size() + to];
  }
};

/// The two directions across the axis in which it is moved.
[[nodiscard]] Eigen::Matrix<double, 3, 2> perpendicular_directions(const Turntable& table);

struct BundleOptions {
  double gate_mm = 3.0;               ///< pairs farther apart are not of the same surface
  double free_space_margin_mm = 3.0;  ///< a point farther before what a view saw is seen through
  std::optional<std::size_t> left_out = std::nullopt;  ///< a view that is not compared
};

/// Compares the surfels of each view with the planes that they project onto in each other view.
///
/// shape    `surfels` and `maps`: one a view
/// source   projective association, Blais & Levine 1995; symmetric distance, Rusinkiewicz 2019;
/// Tukey's
///          biweight
[[nodiscard]] BundleSums sum_bundle(std::span<const std::vector<SurfelMap::Surfel>> surfels,
                                    std::span<const SurfelMap> maps,
                                    const FastCameraModel& model,
                                    const TableState& state,
                                    const BundleOptions& options);

/// The state after a step in the unknowns.
[[nodiscard]] TableState apply_update(const TableState& state, const Eigen::VectorXd& step);

}  // namespace frangia
