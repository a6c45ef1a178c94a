#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "frangia/registration/explain/internal/pose_evidence.h"
#include "frangia/registration/explain/internal/pose_hypotheses.h"
#include "frangia/registration/explain/internal/pose_sums.h"
#include "frangia/registration/register_views.h"

namespace frangia {

/// The chart in which hypotheses are linear: motions of the views from a state of the table, and
/// what axis and angles contribute to them.
struct PoseChart {
  TableState state;                     ///< where the motions are 0
  std::vector<Eigen::Isometry3d> from;  ///< object_from_rig of each view in it
  Eigen::VectorXd table_sigma;          ///< stated or assumed, of each unknown of the table
  Eigen::VectorXd exact_share;          ///< of `table_sigma`, if the table is nearly exact
  Eigen::MatrixXd table;                ///< T of `PoseEvidence`, of the views alone
  Eigen::VectorXd stated;               ///< the motions of the state from what is stated
  PoseSetting setting;

  /// The chart of a table that is nearly exact where the rig states no standard deviations.
  [[nodiscard]] PoseChart with_exact_table() const;
  /// Motions x from what is stated, of views that are in other poses.
  [[nodiscard]] Eigen::VectorXd motions_to(const std::vector<Eigen::Isometry3d>& poses) const;
  /// object_from_rig of each view after motions x.
  [[nodiscard]] std::vector<Eigen::Isometry3d> poses_at(const Eigen::VectorXd& motion) const;
  /// The table after its changes in units of their standard deviations.
  [[nodiscard]] TableState table_at(const TableState& given, const Eigen::VectorXd& changes) const;
};

/// The chart about a state of the table.
///
/// @shape    `times`: of each view, as `times_of` has them
[[nodiscard]] PoseChart make_chart(const Bundle& bundle,
                                   const SurfelLists& surfels,
                                   const TableState& state,
                                   const std::vector<double>& times,
                                   const RegisterOptions& options);

/// Lets every view move by itself to where its surface fits the others. `bundle.gate_mm` is that of
/// the start and of the end.
void free_poses(Bundle& bundle,
                const SurfelLists& surfels,
                std::vector<Eigen::Isometry3d>& poses,
                const PoseChart& chart,
                const RegisterOptions& options,
                const Run& run);

/// How far the distances of the pairs scatter, and how much information they hold.
struct PairNoise {
  double excess = 1.0;  ///< of the distances over their noise, at least 1
  double scatter_mm = 0.0;
  double shared_mm = 0.0;  ///< what all pairs of a region of two views have in common
  double regions = 0.0;    ///< how many show it
  /// Share of the regions that the richest hypothesis does not follow, whatever they have in
  /// common.
  double left_share = 1.0;
  double scale = 1.0;  ///< of the equations, so that they count as independent samples
};

/// The noise of pairs once motions x explain what they can.
///
/// @shape    `plain`: the sums as they are, unscaled
[[nodiscard]] PairNoise noise_after(const Bundle& bundle,
                                    const PoseSums& sums,
                                    const PoseEvidence& plain,
                                    const Eigen::VectorXd& at,
                                    const Eigen::VectorXd& motion);

/// The equations in motions from what is stated, not from where the views are.
[[nodiscard]] NormalEquations from_stated(NormalEquations data, const Eigen::VectorXd& at);

/// A matrix with rows of zeros below.
[[nodiscard]] Eigen::MatrixXd padded(const Eigen::MatrixXd& some, Eigen::Index rows);

}  // namespace frangia
