#include "frangia/registration/internal/explain_poses.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "frangia/registration/explain/internal/correct_poses.h"
#include "frangia/registration/explain/internal/describe_explanation.h"
#include "frangia/registration/explain/internal/displace_views.h"
#include "frangia/registration/explain/internal/scored_round.h"
#include "frangia/registration/explain/internal/spread_of_causes.h"
#include "frangia/registration/refine_rig.h"

namespace frangia {
namespace {

/// Whether views that are moved by themselves fit noticeably better than the table places them.
bool is_suspicious(const Registration& work, const PoseChart& chart) {
  // Of the reach: views that do not fit are outside of the gate of those that do.
  constexpr double kOpen = 0.3;
  PoseRound round{.bundle = work.bundle, .chart = chart, .poses = chart.from};
  round.bundle.gate_mm = std::max(work.bundle.gate_mm, kOpen * work.reach_mm);
  round.sums = sum_poses(round.bundle, work.surfels, {round.poses, nullptr});
  weigh(round);
  const PosePosterior free =
      round.posterior({PoseCause::Unexplained, {}, 0.001 * chart.setting.distance_mm, 0.0});
  const double effect_mm = round.effect_mm(free.motion - round.stated());
  // Poses do not explain a wrong rig: what pairs have in common here may be just that.
  constexpr double kSystematic = 2.5;  // times the error that sound views have in common
  return effect_mm > std::max(kSystematic * round.bundle.systematic_mm, round.noise.scatter_mm);
}

/// The parameters of the rig that changed most, in standard deviations of their prior.
std::vector<std::string> terms_of(const DriftModel& model, const Eigen::VectorXd& changes) {
  constexpr double kMost = 0.5;  // of the largest
  const Eigen::VectorXd all = model.factor() * changes;
  const Eigen::VectorXd prior = model.factor().rowwise().norm();
  const Eigen::VectorXd shares = all.cwiseAbs().cwiseQuotient(prior.cwiseMax(1e-300));
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
  explanation.effect_mm = round.effect_mm(found.motion - round.stated());
  explanation.unexplained_mm = round.noise.shared_mm;
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

/// The hypotheses on the pairs of the fit in which every view moves by itself, its points measured
/// by the rig after some changes.
PoseRound scored_round(const Registration& work,
                       const TurntableStations& given,
                       const std::optional<DriftModel>& model,
                       const Eigen::VectorXd& rig_at) {
  const PoseChart chart = make_chart(work.bundle, work.surfels, work.bundle.state, work.options);
  PoseRound round{.bundle = work.bundle, .chart = chart, .poses = chart.from};
  SurfelLists surfels = work.surfels;
  if (rig_at.size() > 0 && !rig_at.isZero()) {
    const std::vector<Rig> rigs = rigs_of_views(*model, chart.setting.times, rig_at);
    displace_views(round.bundle.maps, *given.rig, rigs, *given.pattern);
    surfels = pick_all_surfels(round.bundle.maps, surfels_to_explain(work.views.size()));
  }
  round.bundle.gate_mm = work.reach_mm;
  free_poses(round.bundle, surfels, round.poses, round.chart, work.options, work.run);
  if (model) {
    round.rig_at = rig_at;
    round.rig = rig_changes(*model, *given.pattern, chart.setting.times, round.rig_at);
    round.chart.setting.rig_changes = model->count();
  }
  round.sums = sum_poses(round.bundle, surfels, {round.poses, round.rig ? &*round.rig : nullptr});
  round.surfaces = surfaces_of(surfels, round.poses);
  score(round);
  return round;
}

/// The hypotheses, linearized again at the rig that they find.
PoseRound scored_at_found_rig(const Registration& work,
                              const TurntableStations& given,
                              const std::optional<DriftModel>& model) {
  constexpr int kTurns = 3;
  constexpr double kSame = 0.05;  // of the changes: points move with them linearly so far
  Eigen::VectorXd rig_at = Eigen::VectorXd::Zero(model ? 2 * model->count() : 0);
  PoseRound round = scored_round(work, given, model, rig_at);
  for (int turn = 1; turn < kTurns; ++turn) {
    const std::size_t first = winner_of(round);
    if (!changes_rig(round.causes[first].cause)) break;
    const Eigen::VectorXd found = round.motions[first].tail(rig_at.size());
    if ((found - rig_at).norm() < kSame * found.norm()) break;
    PoseRound next = scored_round(work, given, model, found);
    // Far from the rig that is stated the views may slide off each other: what was found stays.
    if (!changes_rig(next.causes[winner_of(next)].cause)) break;
    rig_at = found;
    round = std::move(next);
  }
  return round;
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
  const PoseChart chart = make_chart(work.bundle, work.surfels, work.bundle.state, work.options);
  if (!is_suspicious(work, chart)) return all;
  std::optional<DriftModel> model;
  if (given.rig != nullptr && given.pattern != nullptr)
    model.emplace(*given.rig, RefineRigOptions{}, chart.setting.distance_mm);
  const PoseRound round = scored_at_found_rig(work, given, model);
  const std::size_t first = winner_of(round);
  const ScoredCause winner = round.causes[first];
  PoseExplanation& explanation = all.explanation;
  measure(explanation, work, round, winner);
  if (winner.cause == PoseCause::AsStated || explanation.effect_mm < noticeable_mm(round)) {
    explanation = {};
    const auto stated = std::find_if(round.causes.begin(), round.causes.end(), [](const auto& c) {
      return c.cause == PoseCause::AsStated;
    });
    all.spread = spread_of_causes(round, *stated, work).of_views();
    return all;
  }
  compare(explanation, round, first);
  if (changes_rig(winner.cause)) {
    const Eigen::VectorXd changes = round.motions[first].tail(2 * model->count());
    const bool drifts = winner.cause == PoseCause::RigDrift;
    explanation.terms =
        terms_of(*model, drifts ? changes.tail(model->count()) : changes.head(model->count()));
    if (drifts) {
      all.rigs = rigs_of_views(*model, chart.setting.times, changes);
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
