#include "frangia/registration/internal/explain_poses.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "frangia/core/median.h"
#include "frangia/registration/explain/internal/correct_poses.h"
#include "frangia/registration/explain/internal/describe_explanation.h"
#include "frangia/registration/explain/internal/displace_views.h"
#include "frangia/registration/explain/internal/pose_round.h"
#include "frangia/registration/explain/internal/scored_round.h"
#include "frangia/registration/explain/internal/spread_of_causes.h"
#include "frangia/registration/explain/internal/time_profiles.h"
#include "frangia/registration/refine_rig.h"

namespace frangia {
namespace {

/// Whether the views are where only axis or angles would put them that are not to be expected.
bool is_beyond_prior(const PoseRound& round) {
  constexpr double kUnlikely = 3.5;  // standard deviations of a change
  const auto own = static_cast<Eigen::Index>(round.chart.setting.views) + 3;
  return round.posterior({}).table.head(own).cwiseAbs().maxCoeff() > kUnlikely;
}

/// Scores the hypotheses on the pairs of the views in the poses of a round.
///
/// @shape    `rig_at`: changes of the rig with which the surfels are measured, as
///           `changes_of_views` has them
void score_pairs(PoseRound& round,
                 const SurfelLists& surfels,
                 const TurntableStations& given,
                 const std::optional<DriftModel>& model,
                 const Eigen::VectorXd& rig_at) {
  if (model) {
    round.rig_at = rig_at;
    round.rig = rig_changes(*model, *given.pattern, round.chart.setting.rig_basis, rig_at);
    round.chart.setting.rig_changes = model->count();
  }
  const RigChanges* rig = round.rig ? &*round.rig : nullptr;
  round.sums = sum_poses(round.bundle, surfels, {round.poses, rig});
  score(round);
}

/// No changes of the rig in any view.
Eigen::VectorXd rig_as_stated(const std::optional<DriftModel>& model, const PoseChart& chart) {
  return Eigen::VectorXd::Zero(model ? chart.setting.rig_basis.cols() * model->count() : 0);
}

/// The hypotheses on the pairs of the views as the table places them, which needs no iterations.
PoseRound scored_as_placed(const Registration& work,
                           const TurntableStations& given,
                           const std::optional<DriftModel>& model,
                           const PoseChart& chart) {
  // Of the reach: views that do not fit are outside of the gate of those that do.
  constexpr double kOpen = 0.3;
  PoseRound round{.bundle = work.bundle, .chart = chart, .poses = chart.from};
  round.bundle.gate_mm = std::max(work.bundle.gate_mm, kOpen * work.reach_mm);
  score_pairs(round, work.surfels, given, model, rig_as_stated(model, chart));
  return round;
}

const ScoredCause& as_stated(const PoseRound& round) {
  return *std::find_if(round.causes.begin(), round.causes.end(), [](const ScoredCause& cause) {
    return cause.cause == PoseCause::AsStated;
  });
}

/// The parameters of the rig that changed most, in standard deviations of their prior: from what is
/// stated, or by the way between the views.
///
/// @shape    `changes`: terms x views
std::vector<std::string> terms_of(const DriftModel& model,
                                  const Eigen::MatrixXd& changes,
                                  bool drifts) {
  constexpr double kMost = 0.5;  // of the largest
  const Eigen::MatrixXd all = model.factor() * changes;
  const Eigen::VectorXd way = all.rowwise().maxCoeff() - all.rowwise().minCoeff();
  const Eigen::VectorXd prior = model.factor().rowwise().norm();
  const Eigen::VectorXd shares =
      (drifts ? way : all.col(0)).cwiseAbs().cwiseQuotient(prior.cwiseMax(1e-300));
  std::vector<std::string> names;
  for (Eigen::Index i = 0; i < shares.size(); ++i) {
    if (shares[i] > kMost * shares.maxCoeff())
      names.push_back(model.parameters()[static_cast<std::size_t>(i)]);
  }
  return names;
}

/// The largest of the motions of the part that a cause consists of: how far its centre moved, and
/// how far it turned about it.
void measure_motion(PoseExplanation& explanation,
                    const PosePosterior& found,
                    const CauseHypothesis& cause,
                    double radius_mm) {
  constexpr double kTurns = 0.2;  // share of the motion that is a rotation worth a word
  double largest = -1.0;
  const Eigen::Matrix<double, 6, 1> scales = cause.scale * shares_of_motion(cause.slides);
  for (Eigen::Index at = 0; at < found.changes.size(); at += 6) {
    const Eigen::Matrix<double, 6, 1> motion = scales.cwiseProduct(found.changes.segment<6>(at));
    const Eigen::Vector3d arc = motion.head<3>();
    const Eigen::Vector3d way = motion.tail<3>();
    const double size = arc.squaredNorm() + way.squaredNorm();
    if (size < largest) continue;
    largest = size;
    // What no overlap sees of it counts, too.
    const Eigen::Matrix<double, 6, 1> variances =
        scales.cwiseAbs2().cwiseProduct(found.changes_covariance.diagonal().segment<6>(at));
    const double arc_sigma_mm = std::sqrt(variances.head<3>().sum());
    explanation.moved_mm = way.norm();
    explanation.moved_sigma_mm = std::sqrt(variances.tail<3>().sum());
    const bool turned = arc.norm() > 3.0 * arc_sigma_mm && arc.norm() > kTurns * std::sqrt(size);
    explanation.turned_rad = turned ? arc.norm() / radius_mm : kMissing;
    explanation.turned_sigma_rad = turned ? arc_sigma_mm / radius_mm : kMissing;
  }
}

/// What the winner found, in numbers.
void measure(PoseExplanation& explanation,
             const Registration& work,
             const PoseRound& round,
             const ScoredCause& winner) {
  explanation.best = winner.cause;
  const PosePosterior found = round.posterior(winner.best);
  const double scale = winner.best.scale;
  explanation.views = winner.best.views;
  // A table that the views put beyond its prior is an explanation only in want of a better one.
  const Eigen::VectorXd stated =
      is_beyond_prior(round) ? Eigen::VectorXd::Zero(found.motion.size()) : round.stated();
  explanation.effect_mm = round.effect_mm(found.motion - stated);
  explanation.unexplained_mm = round.noise.shared_mm;
  if (is_drift(winner.cause)) {
    explanation.time_constant = time_constant_of(winner.best.profile);
    explanation.times_assumed = !are_times_stated(work.stations);
  }
  switch (winner.cause) {
    case PoseCause::Turned:
      // The points turn back by what the table has turned too far.
      explanation.turned_rad = -scale / round.chart.setting.radius_mm * found.changes[0];
      break;
    case PoseCause::AnglesScaled:
      explanation.scale = work.angle_factor * (1.0 - scale * found.changes[0]);
      break;
    case PoseCause::PartMoved:
    case PoseCause::PartMovedTwice:
    case PoseCause::ViewMoved:
    case PoseCause::ViewsMoved:
    case PoseCause::PartDrift:
      measure_motion(explanation, found, winner.best, round.chart.setting.radius_mm);
      break;
    case PoseCause::Wobble:
      explanation.scale = scale;
      break;
    default:
      break;
  }
}

/// Views as the table places them that was refined with their points as rigs of their own measure
/// them.
struct PlacedViews {
  Eigen::VectorXd rig_at;  ///< changes of the rig, as `changes_of_views` has them
  Bundle bundle;
  SurfelLists surfels;
  double apart_mm = 0.0;  ///< median distance of the pairs within the reach
  std::size_t pairs = 0;

  void compare(double reach_mm) {
    Bundle open = bundle;
    open.gate_mm = reach_mm;
    const BundleSums sums = sum(open, surfels);
    apart_mm = static_cast<double>(median(sums.distances_mm));
    pairs = sums.distances_mm.size();
  }
};

PlacedViews placed_as_stated(const Registration& work, Eigen::VectorXd rig_at) {
  PlacedViews placed{std::move(rig_at), work.bundle, work.surfels};
  placed.compare(work.reach_mm);
  return placed;
}

PlacedViews placed_by(const Registration& work,
                      const TurntableStations& given,
                      const DriftModel& model,
                      Eigen::VectorXd rig_at) {
  PlacedViews placed{std::move(rig_at), work.bundle, {}};
  const Eigen::MatrixXd basis = basis_of_profiles(times_of(work.stations));
  displace_views(
      placed.bundle.maps, *given.rig, rigs_of_views(model, basis, placed.rig_at), *given.pattern);
  placed.surfels = pick_all_surfels(placed.bundle.maps, surfels_to_explain(work.views.size()));
  placed.bundle.state = placed.bundle.given;
  placed.bundle.gate_mm = work.reach_mm;
  optimize_bundle(placed.bundle, placed.surfels, work.options.max_iterations, work.run);
  placed.compare(work.reach_mm);
  return placed;
}

/// The poses on whose pairs hypotheses are scored.
enum class ScoredPoses : std::uint8_t {
  OfTable,  ///< as the table places the views
  Free      ///< where every view fits by itself
};

/// The hypotheses on the pairs of views that were placed.
PoseRound scored_round(const Registration& work,
                       const TurntableStations& given,
                       const std::optional<DriftModel>& model,
                       const PlacedViews& placed,
                       ScoredPoses poses) {
  const PoseChart chart = make_chart(
      placed.bundle, placed.surfels, placed.bundle.state, times_of(work.stations), work.options);
  PoseRound round{.bundle = placed.bundle, .chart = chart, .poses = chart.from};
  round.bundle.gate_mm = work.reach_mm;
  if (poses == ScoredPoses::Free)
    free_poses(round.bundle, placed.surfels, round.poses, round.chart, work.options, work.run);
  round.surfaces = surfaces_of(placed.surfels, round.poses);
  score_pairs(round, placed.surfels, given, model, placed.rig_at);
  return round;
}

/// The rig of one of the causes with which the table places the views best; none where it does so
/// hardly better than before. Where free views slid off each other the odds do not say it.
std::optional<PlacedViews> best_placed(const Registration& work,
                                       const TurntableStations& given,
                                       const DriftModel& model,
                                       const PoseRound& round,
                                       const PlacedViews& before) {
  constexpr double kBetter = 0.95;
  constexpr double kAsMany = 0.9;  // pairs: views that do not meet agree, too
  std::optional<PlacedViews> best;
  double least_mm = kBetter * before.apart_mm;
  for (std::size_t i = 0; i < round.causes.size(); ++i) {
    if (!changes_rig(round.causes[i].cause) || round.causes[i].log_odds < 0.0) continue;
    PlacedViews placed = placed_by(work, given, model, round.motions[i].tail(before.rig_at.size()));
    const auto fewest = static_cast<std::size_t>(kAsMany * static_cast<double>(before.pairs));
    if (placed.apart_mm > least_mm || placed.pairs < fewest) continue;
    least_mm = placed.apart_mm;
    best = std::move(placed);
  }
  return best;
}

/// A round, and the views that it is about.
struct RoundOfViews {
  PoseRound round;
  PlacedViews placed;
};

/// The hypotheses, linearized again at the rig that they find, as long as the table places the
/// views better with it: points move with the rig linearly to a tenth only.
RoundOfViews at_found_rig(const Registration& work,
                          const TurntableStations& given,
                          const DriftModel& model,
                          RoundOfViews found,
                          ScoredPoses poses) {
  constexpr int kTurns = 4;
  for (int turn = 1; turn < kTurns; ++turn) {
    std::optional<PlacedViews> better = best_placed(work, given, model, found.round, found.placed);
    if (!better) break;
    PoseRound next = scored_round(work, given, model, *better, poses);
    // Far from the rig that is stated the views may slide off each other: what was found stays.
    if (!changes_rig(next.causes[winner_of(next)].cause)) break;
    found = {std::move(next), std::move(*better)};
  }
  return found;
}

/// The hypotheses about views that are not all where the table places them.
PoseRound scored_again(const Registration& work,
                       const TurntableStations& given,
                       const std::optional<DriftModel>& model,
                       const PoseRound& as_placed) {
  PlacedViews placed = placed_as_stated(work, rig_as_stated(model, as_placed.chart));
  if (!model) return scored_round(work, given, model, placed, ScoredPoses::Free);
  // Views of a wrong rig slide off each other once they are free: its hypothesis goes first.
  if (changes_rig(as_placed.causes[winner_of(as_placed)].cause)) {
    RoundOfViews found =
        at_found_rig(work, given, *model, {as_placed, placed}, ScoredPoses::OfTable);
    if (!found.placed.rig_at.isZero()) return std::move(found.round);
  }
  PoseRound round = scored_round(work, given, model, placed, ScoredPoses::Free);
  RoundOfViews free{std::move(round), std::move(placed)};
  return at_found_rig(work, given, *model, std::move(free), ScoredPoses::Free).round;
}

/// The second best of the causes, and those that move the views as the winner does.
void compare(PoseExplanation& explanation, const PoseRound& round, std::size_t first) {
  const ScoredCause& winner = round.causes[first];
  bool has_second = false;
  for (std::size_t i = 0; i < round.causes.size(); ++i) {
    const ScoredCause& other = round.causes[i];
    if (i == first) continue;
    if (are_alike(round, first, i)) {
      if (freedom_of(other.cause) <= freedom_of(winner.cause) &&
          other.log_odds > winner.log_odds - kNamed)
        explanation.alike.push_back(other.cause);
    } else if (!has_second) {
      has_second = true;
      explanation.second = other.cause;
      explanation.log_odds = round.causes.front().log_odds - other.log_odds;
    }
  }
  // The same cause at other views counts against it, too.
  for (const CauseHypothesis& other : winner.others) {
    const double log_odds = winner.log_odds - other.log_odds;
    if (log_odds > std::min(kNamed, explanation.log_odds)) break;
    if (are_alike(round,
                  {winner.cause, round.motions[first]},
                  {winner.cause, round.posterior(other).motion}))
      continue;
    explanation.second = winner.cause;
    explanation.log_odds = log_odds;
    break;
  }
  explanation.log_odds_stated = winner.log_odds - round.log_odds_of(PoseCause::AsStated);
  explanation.decided = explanation.log_odds > kNamed && explanation.log_odds_stated > kNamed &&
                        predicts(round, winner.best);
}

}  // namespace

ExplainedPoses explain_poses(const Registration& work,
                             const TurntableStations& given,
                             std::size_t dense) {
  ExplainedPoses all;
  const PoseChart chart = make_chart(
      work.bundle, work.surfels, work.bundle.state, times_of(work.stations), work.options);
  std::optional<DriftModel> model;
  if (given.rig != nullptr && given.pattern != nullptr)
    model.emplace(*given.rig, RefineRigOptions{}, chart.setting.distance_mm);
  const PoseRound placed = scored_as_placed(work, given, model, chart);
  // Sound views need no more than this; others are looked at where they fit by themselves.
  if (placed.causes.front().cause == PoseCause::AsStated) {
    all.spread = spread_of_causes(placed, placed.causes.front(), work).of_views();
    return all;
  }
  const PoseRound round = scored_again(work, given, model, placed);
  const std::size_t first = winner_of(round);
  const ScoredCause winner = round.causes[first];
  PoseExplanation& explanation = all.explanation;
  measure(explanation, work, round, winner);
  // Views that all move by themselves follow what their rims have in common, too.
  constexpr double kEach = 1.5;
  const bool each_moves =
      winner.cause == PoseCause::Unexplained || winner.cause == PoseCause::Wobble;
  const double least_mm = (each_moves ? kEach : 1.0) * noticeable_mm(round);
  if (winner.cause == PoseCause::AsStated || explanation.effect_mm < least_mm) {
    explanation = {};
    all.spread = spread_of_causes(round, as_stated(round), work).of_views();
    return all;
  }
  compare(explanation, round, first);
  if (changes_rig(winner.cause)) {
    const Eigen::VectorXd of_rig = round.motions[first].tail(round.rig_at.size());
    const Eigen::MatrixXd changes = changes_of_views(of_rig, round.rig->basis);
    const bool drifts = winner.cause == PoseCause::RigDrift;
    explanation.terms = terms_of(*model, changes, drifts);
    if (drifts) {
      all.rigs = rigs_of_views(*model, round.rig->basis, of_rig);
      const PoseSpread own = spread_of_winner(round, round.posterior(winner.best), work);
      all.spread = (own + spread_of_causes(round, winner, work)).of_views();
    }
  }
  if (moves_views(winner.cause)) all.corrected = correct_poses(round, winner, work, dense);
  if (!all.corrected && all.spread.empty())
    all.spread = spread_of_causes(round, winner, work).of_views();
  const auto names = [&](std::size_t view) { return work.name_of(view); };
  explanation.text = describe(explanation, names);
  explanation.remedy = remedy_of(explanation, work.options.wrong_rig);
  return all;
}

}  // namespace frangia
