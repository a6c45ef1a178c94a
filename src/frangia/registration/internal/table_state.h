#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "frangia/registration/view_motions.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// The unknowns of a turntable registration: the axis, the angle of each view, and the part pose of
/// each setup but the first.
///
/// A step in the unknowns holds, in this order: two tilts of the axis about
/// `perpendicular_directions` (rad), two shifts along them (mm), the angles of views 1, 2, ...
/// (rad; view 0 is held), then three shifts (mm) and three rotations (rad) about the table's point
/// for the part pose of each further setup.
struct TableState {
  Turntable table;
  std::vector<double> angles_rad;
  std::vector<std::size_t> setups;  ///< of each view; empty: all in the first
  /// Of each further setup: the part's pose relative to the first setup, both at angle 0, rig
  /// frame.
  std::vector<Eigen::Isometry3d> part_poses{};

  [[nodiscard]] std::size_t setup_of(std::size_t view) const {
    return setups.empty() ? 0 : setups[view];
  }
  [[nodiscard]] Eigen::Isometry3d part_pose(std::size_t setup) const {
    return setup == 0 ? Eigen::Isometry3d::Identity() : part_poses[setup - 1];
  }
  [[nodiscard]] Eigen::Index unknowns() const {
    return static_cast<Eigen::Index>(angles_rad.size() + 3 + 6 * part_poses.size());
  }
  /// Index of the first unknown of a further setup.
  [[nodiscard]] Eigen::Index index_of_setup(std::size_t setup) const {
    return static_cast<Eigen::Index>(angles_rad.size() + 3 + 6 * (setup - 1));
  }
  /// The last view of the first setup, which closes the turn to view 0.
  [[nodiscard]] std::size_t closing_view() const;
};

/// The two unit directions perpendicular to the axis in which it tilts and shifts.
[[nodiscard]] Eigen::Matrix<double, 3, 2> perpendicular_directions(const Turntable& table);

/// The refined table with its point nearest to the given one.
[[nodiscard]] Turntable nearest_to(const Turntable& given, Turntable refined);

/// The state after a step in the unknowns.
[[nodiscard]] TableState apply_update(const TableState& state, const Eigen::VectorXd& step);

/// The difference of a state from the given one, in the unknowns. That of part poses is 0: they
/// have no prior.
[[nodiscard]] Eigen::VectorXd deviation(const TableState& state, const TableState& given);

/// Poses of the object in the rig frame, by view.
[[nodiscard]] std::vector<Eigen::Isometry3d> object_poses(const TableState& state);

/// The motions of the views by each unknown, for a change of 1.
[[nodiscard]] ViewMotions motions_by_unknown(const TableState& state);

/// Standard deviations of the unknowns, part poses being unknown by `prior_sigma`.
[[nodiscard]] Eigen::VectorXd sigmas_of(const TableState& state,
                                        const TurntableSigma& sigma,
                                        const Eigen::VectorXd& prior_sigma);

/// Returns the motions of the views by what is left of `prior_sigma` where pairs of views add the
/// `information`. Where these pairs fit best at an `offset` from the state that is kept, the part
/// of it that they and the prior agree on is one motion more,
/// in directions that they determine badly.
///
/// @shape    `prior_sigma`: the unknowns of the state, 0 for what is exact; `information`: a square
///           matrix of them, or empty for none; `offset`: the unknowns
[[nodiscard]] ViewMotions state_motions(const TableState& state,
                                        const Eigen::VectorXd& prior_sigma,
                                        const Eigen::MatrixXd& information,
                                        const Eigen::VectorXd& offset);

}  // namespace frangia
