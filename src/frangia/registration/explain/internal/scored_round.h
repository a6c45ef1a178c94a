#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/registration/explain/internal/pose_hypotheses.h"
#include "frangia/registration/explain/internal/pose_round.h"

namespace frangia {

/// Natural logarithm of the odds from which on a cause is named: 100 : 1.
inline constexpr double kNamed = 4.605;

/// The hypotheses, scored about one state of table and rig.
struct PoseRound {
  Bundle bundle;
  PoseChart chart;
  std::vector<Eigen::Isometry3d> poses{};
  std::optional<RigChanges> rig{};
  Eigen::VectorXd rig_at{};  ///< changes of the rig, as `changes_of_views` has them
  PoseSums sums{};
  PairNoise noise{};
  std::optional<PoseEvidence> evidence{};
  std::optional<PoseEvidence> exact{};  ///< the same with a table that is nearly exact
  /// How motions displace the surface of each view along its normals: mean squares.
  std::vector<Eigen::Matrix<double, 6, 6>> surfaces{};
  std::vector<ScoredCause> causes{};       ///< the most probable first
  std::vector<Eigen::VectorXd> motions{};  ///< by each of them

  [[nodiscard]] Eigen::VectorXd at() const {
    Eigen::VectorXd all = chart.motions_to(poses);
    const Eigen::Index views = all.size();
    all.conservativeResize(views + rig_at.size());
    all.tail(rig_at.size()) = rig_at;
    return all;
  }
  /// The equations of the ties, in motions from what is stated; none without ties.
  [[nodiscard]] std::optional<NormalEquations> ties() const {
    if (bundle.ties.empty()) return {};
    return from_stated(sum_pose_ties(bundle, {poses, rig ? &*rig : nullptr}), at());
  }
  [[nodiscard]] PosePosterior posterior(const CauseHypothesis& of) const {
    const PoseEvidence& by = of.exact_table ? *exact : *evidence;
    return by.posterior(motions_of(of, chart.setting, by.data().gradient.size()));
  }
  /// Root mean square over the pairs of what a difference of motions changes.
  [[nodiscard]] double effect_mm(const Eigen::VectorXd& difference) const {
    double squares = 0.0;
    for (const NormalEquations& half : sums.halves)
      squares += difference.dot(half.hessian * difference);
    return std::sqrt(std::max(0.0, squares / sums.weight));
  }
  /// Root mean square over the surfaces of the views of what a difference of motions changes, but
  /// for a motion of all of them.
  [[nodiscard]] double surface_mm(const Eigen::VectorXd& difference) const;
  /// The motions as rig and table are stated.
  [[nodiscard]] Eigen::VectorXd stated() const { return posterior({}).motion; }
  [[nodiscard]] double log_odds_of(PoseCause cause) const {
    const auto at = std::find_if(
        causes.begin(), causes.end(), [&](const ScoredCause& c) { return c.cause == cause; });
    return at == causes.end() ? 0.0 : at->log_odds;
  }
};

/// `surfaces` of a round.
[[nodiscard]] std::vector<Eigen::Matrix<double, 6, 6>> surfaces_of(
    const SurfelLists& surfels, const std::vector<Eigen::Isometry3d>& object_from_rig);

/// Prepares the equations of a round, with the noise that its richest hypothesis leaves.
void weigh(PoseRound& round);

/// Sums the pairs of the views in the poses of a round.
///
/// @shape    `rig_at`: changes of the rig that measured the surfels, as `changes_of_views` has them
void sum_pairs(PoseRound& round,
               const SurfelLists& surfels,
               const TurntableStations& given,
               const std::optional<DriftModel>& model,
               const Eigen::VectorXd& rig_at);

/// Scores all hypotheses on the pairs of a round, with the noise that they have.
void score(PoseRound& round);

/// The same with a noise that is known.
void score_with(PoseRound& round, const PairNoise& noise);

/// The smallest effect that is explained: what surfaces of sound scans have in common is not
/// blamed, nor what is far below the scatter of one pair; where too few regions tell what they have
/// in common, nor what one pair hides.
[[nodiscard]] double noticeable_mm(const PoseRound& round);

/// Whether only an improbable change of axis or angles would explain the poses of the views.
[[nodiscard]] bool is_beyond_prior(const PoseRound& round);

/// The change of distances between the views by one of the causes, by its index: root mean square
/// over the pairs. It is relative to the best axis and angles; where these alone would be beyond
/// their prior and the cause needs no such change, relative to the stated ones.
[[nodiscard]] double effect_of(const PoseRound& round, std::size_t cause);

/// Whether the effect of one of the causes, by its index, is noticeable. A cause with a smaller
/// effect may be probable only because it fits errors that surfaces of sound scans have in common.
[[nodiscard]] bool is_noticeable(const PoseRound& round, std::size_t cause);

[[nodiscard]] bool changes_rig(PoseCause cause);

/// Whether a cause is a course in time.
[[nodiscard]] bool is_drift(PoseCause cause);

/// How much a cause says: that which says less must explain more.
[[nodiscard]] int freedom_of(PoseCause cause);

/// Motions of the views by a cause.
struct CauseMotion {
  PoseCause cause = PoseCause::AsStated;
  Eigen::VectorXd motion{};
};

/// Whether two causes move the views alike: their surfaces, not only where others overlap with
/// them.
[[nodiscard]] bool are_alike(const PoseRound& round,
                             const CauseMotion& one,
                             const CauseMotion& other);

/// The same of two of the causes, by their index.
[[nodiscard]] bool are_alike(const PoseRound& round, std::size_t one, std::size_t other);

/// The index of the most probable noticeable cause; that of `AsStated` if there is none.
[[nodiscard]] std::size_t most_probable_of(const PoseRound& round);

/// The index of the winner: the most probable cause, or a simpler one that moves the views alike.
[[nodiscard]] std::size_t winner_of(const PoseRound& round);

/// Whether the pairs of either half of the regions are predicted by what the other half finds.
[[nodiscard]] bool predicts(const PoseRound& round, const CauseHypothesis& hypothesis);

}  // namespace frangia
