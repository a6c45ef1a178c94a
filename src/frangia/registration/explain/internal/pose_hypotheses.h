#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/registration/explain/internal/pose_evidence.h"
#include "frangia/registration/explain/pose_explanation.h"

namespace frangia {

/// What the hypotheses are made of.
struct PoseSetting {
  std::size_t views = 0;
  std::vector<double> angles_rad;  ///< stated, of each view
  std::vector<double> times;       ///< of each view, from -0.5 to 0.5
  Eigen::Vector3d center_mm;       ///< of the part, object frame
  double radius_mm = 1.0;          ///< of the part: a rotation counts by its arc there
  double distance_mm = 500.0;      ///< working distance: lengths of priors are shares of it
  Eigen::MatrixXd beyond_stated;   ///< motions by axis and angles that are farther off than
                                   ///< stated; empty: nothing is stated
  Eigen::Index rig_changes = 0;    ///< terms of the rig; 0: it has no unknowns
  Eigen::MatrixXd rig_basis;       ///< functions of time that its changes consist of
  std::vector<Eigen::Isometry3d> object_from_rig;  ///< of each view: how a moved table shows
  /// Of each view, the table that the part stands on in its setup, whose axis is z; object frame.
  /// Empty: that of the object frame.
  std::vector<Eigen::Isometry3d> object_from_table{};
  double tilt_rad = 1e-3;  ///< unit of rotations of a table or projector that is knocked
  double shift_mm = 0.5;   ///< unit of their shifts
  /// Changes of the rig by a motion of the projector, by each unit; terms x 6. Empty: none.
  Eigen::MatrixXd projector_moves;
};

/// One hypothesis, with its odds.
struct CauseHypothesis {
  PoseCause cause = PoseCause::AsStated;
  std::vector<std::size_t> views;  ///< as `PoseExplanation` has them
  double scale = 0.0;              ///< standard deviation of its changes: mm, or a share
  double log_odds = 0.0;           ///< against what is stated
  bool slides = false;             ///< the part stays on the table; else it may tip or rise, too
  bool exact_table = false;        ///< axis and angles are nearly those of the rig
  std::size_t profile = 0;         ///< of `time_profile`, where something drifts; a `MovedRig`
};

/// Standard deviations of the motions of a part in units of the scale of a hypothesis: three
/// rotations about its centre, as arcs, and three shifts, object frame.
[[nodiscard]] Eigen::Matrix<double, 6, 1> shares_of_motion(bool slides);

/// All hypotheses of one cause.
struct ScoredCause {
  PoseCause cause = PoseCause::AsStated;
  double log_odds = 0.0;  ///< mean over the hypotheses of this cause: each is as probable
  CauseHypothesis best;
  /// Those that explain the data nearly as well, with other views or another course in time, the
  /// most probable first; their odds share those of the cause.
  std::vector<CauseHypothesis> others{};
};

/// The motions of a hypothesis by its own changes: U of `PoseEvidence`.
[[nodiscard]] Eigen::MatrixXd motions_of(const CauseHypothesis& hypothesis,
                                         const PoseSetting& setting,
                                         Eigen::Index unknowns);

/// Scores all hypotheses; by cause, the most probable first. What is stated has odds of 1.
[[nodiscard]] std::vector<ScoredCause> score_causes(const PoseEvidence& evidence,
                                                    const PoseSetting& setting);

}  // namespace frangia
