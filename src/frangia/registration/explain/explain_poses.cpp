#include "frangia/registration/internal/explain_poses.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "frangia/registration/explain/internal/describe_explanation.h"
#include "frangia/registration/explain/internal/displace_views.h"
#include "frangia/registration/explain/internal/pose_round.h"
#include "frangia/registration/refine_rig.h"

namespace frangia {
namespace {

/// Natural logarithm of the odds from which on a cause is named: 100 : 1.
constexpr double kNamed = 4.605;
/// Of a fault before the scan is looked at: one scan in twenty has one.
constexpr double kFaultsAreRare = -3.0;
/// Of a turntable that is not as stated: the last hypothesis.
constexpr double kStatementsHold = -4.6;
/// Share of its effect by which a simpler cause may differ from one that explains more.
constexpr double kAlike = 0.05;
/// The same between changes of the rig: points move with them linearly to a tenth only.
constexpr double kAlikeRigs = 0.3;

/// The hypotheses, scored about one state of table and rig.
struct PoseRound {
  Bundle bundle;
  PoseChart chart;
  std::vector<Eigen::Isometry3d> poses{};
  std::optional<RigChanges> rig{};
  Eigen::VectorXd rig_at{};  ///< constant changes of the rig, then those that grow
  PoseSums sums{};
  PairNoise noise{};
  std::optional<PoseEvidence> evidence{};
  std::vector<ScoredCause> causes{};       ///< the most probable first
  std::vector<Eigen::VectorXd> motions{};  ///< by each of them

  [[nodiscard]] Eigen::VectorXd at() const {
    Eigen::VectorXd all = chart.motions_to(poses);
    const Eigen::Index views = all.size();
    all.conservativeResize(views + rig_at.size());
    all.tail(rig_at.size()) = rig_at;
    return all;
  }
  [[nodiscard]] PosePosterior posterior(const CauseHypothesis& of) const {
    return evidence->posterior(motions_of(of, chart.setting, evidence->data().gradient.size()));
  }
  /// Root mean square over the pairs of what a difference of motions changes.
  [[nodiscard]] double effect_mm(const Eigen::VectorXd& difference) const {
    const double squares = difference.dot(evidence->data().hessian * difference) / noise.scale;
    return std::sqrt(std::max(0.0, squares / sums.weight));
  }
  /// The motions as rig and table are stated.
  [[nodiscard]] Eigen::VectorXd stated() const { return posterior({}).motion; }
  [[nodiscard]] double log_odds_of(PoseCause cause) const {
    const auto at = std::find_if(
        causes.begin(), causes.end(), [&](const ScoredCause& c) { return c.cause == cause; });
    return at == causes.end() ? 0.0 : at->log_odds;
  }
};

/// Motions of the richest hypothesis: every view and the rig are elsewhere.
Eigen::MatrixXd everything(const PoseChart& chart, Eigen::Index unknowns) {
  const CauseHypothesis free{PoseCause::Unexplained, {}, 0.004 * chart.setting.distance_mm, 0.0};
  Eigen::MatrixXd own = motions_of(free, chart.setting, unknowns);
  const Eigen::Index rig = 2 * chart.setting.rig_changes;
  own.conservativeResize(Eigen::NoChange, own.cols() + rig);
  own.rightCols(rig).setZero();
  own.bottomRightCorner(rig, rig).setIdentity();
  return own;
}

/// Prepares the equations of a round, with the noise that its richest hypothesis leaves.
void weigh(PoseRound& round) {
  const Eigen::VectorXd at = round.at();
  NormalEquations data = from_stated(round.sums.all(), at);
  const Eigen::Index unknowns = data.gradient.size();
  const Eigen::MatrixXd table = padded(round.chart.table, unknowns);
  const PoseEvidence plain(data, table);
  const Eigen::VectorXd rich = plain.posterior(everything(round.chart, unknowns)).motion;
  round.noise = noise_after(round.bundle, round.sums, plain, at, rich);
  data.hessian *= round.noise.scale;
  data.gradient *= round.noise.scale;
  round.evidence.emplace(std::move(data), table);
}

/// Scores all hypotheses on the pairs of a round.
void score(PoseRound& round) {
  weigh(round);
  round.causes = score_causes(*round.evidence, round.chart.setting);
  for (ScoredCause& cause : round.causes) {
    if (cause.cause != PoseCause::AsStated) cause.log_odds += kFaultsAreRare;
    if (cause.cause == PoseCause::Turntable) cause.log_odds += kStatementsHold;
  }
  std::stable_sort(
      round.causes.begin(), round.causes.end(), [](const ScoredCause& a, const ScoredCause& b) {
        return a.log_odds > b.log_odds;
      });
  for (const ScoredCause& cause : round.causes)
    round.motions.push_back(round.posterior(cause.best).motion);
}

/// The smallest effect that is explained: what the scatter of the pairs hides is not blamed, nor
/// what surfaces of sound scans have in common.
double noticeable_mm(const PoseRound& round) {
  constexpr double kSystematic = 5.0;  // times the common error of the pairs of two views
  return std::max(kSystematic * round.bundle.systematic_mm, round.noise.scatter_mm);
}

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
  return effect_mm > noticeable_mm(round);
}

/// How much a cause says: that which says less must explain more.
int freedom_of(PoseCause cause) {
  switch (cause) {
    case PoseCause::AsStated:
      return 0;
    case PoseCause::Turned:
    case PoseCause::AnglesScaled:
      return 1;
    case PoseCause::PartMoved:
    case PoseCause::ViewMoved:
    case PoseCause::PartDrift:
      return 2;
    case PoseCause::Rig:
    case PoseCause::Turntable:
      return 3;
    case PoseCause::RigDrift:
      return 4;
    case PoseCause::PartMovedTwice:
      return 5;
    case PoseCause::Wobble:
      return 6;
    case PoseCause::Unexplained:
      break;
  }
  return 7;
}

/// Whether two of the causes, by their index, move the views alike.
bool are_alike(const PoseRound& round, std::size_t one, std::size_t other) {
  const auto of_rig = [&](std::size_t i) {
    return round.causes[i].cause == PoseCause::Rig || round.causes[i].cause == PoseCause::RigDrift;
  };
  const double share = of_rig(one) && of_rig(other) ? kAlikeRigs : kAlike;
  const Eigen::VectorXd none = round.stated();
  const double apart_mm = round.effect_mm(round.motions[one] - round.motions[other]);
  return apart_mm < share * std::min(round.effect_mm(round.motions[one] - none),
                                     round.effect_mm(round.motions[other] - none));
}

/// The index of the winner: the most probable cause, or a simpler one that moves the views alike.
std::size_t winner_of(const PoseRound& round) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < round.causes.size(); ++i) {
    const ScoredCause& cause = round.causes[i];
    if (cause.log_odds > kNamed && freedom_of(cause.cause) < freedom_of(round.causes[best].cause) &&
        are_alike(round, 0, i))
      best = i;
  }
  return best;
}

/// Whether the pairs of either half of the regions are predicted by what the other half finds.
bool predicts(const PoseRound& round, const CauseHypothesis& hypothesis) {
  double gain = 0.0;
  const Eigen::VectorXd at = round.at();
  const Eigen::Index unknowns = at.size();
  const Eigen::MatrixXd own = motions_of(hypothesis, round.chart.setting, unknowns);
  for (std::size_t half = 0; half < 2; ++half) {
    const auto evidence = [&](std::size_t which) {
      NormalEquations data = from_stated(round.sums.halves.at(which), at);
      data.hessian *= round.noise.scale;
      data.gradient *= round.noise.scale;
      return PoseEvidence(std::move(data), padded(round.chart.table, unknowns));
    };
    const PoseEvidence seen = evidence(half);
    const PoseEvidence unseen = evidence(1 - half);
    gain += unseen.loss(seen.posterior(Eigen::MatrixXd(unknowns, 0)).motion) -
            unseen.loss(seen.posterior(own).motion);
  }
  return gain > 0.0;
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

/// What the winner found, in numbers.
void measure(PoseExplanation& explanation, const PoseRound& round, const ScoredCause& winner) {
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
      explanation.scale = 1.0 - scale * found.changes[0];
      break;
    case PoseCause::PartMoved:
    case PoseCause::ViewMoved:
    case PoseCause::PartDrift: {
      const Eigen::Vector3d way = scale * found.changes.tail<3>();
      explanation.moved_mm = way.norm();
      // What no overlap sees of it counts, too.
      explanation.moved_sigma_mm =
          scale * std::sqrt(found.changes_covariance.bottomRightCorner<3, 3>().trace());
      break;
    }
    case PoseCause::Wobble:
      explanation.scale = scale;
      break;
    default:
      break;
  }
}

/// The motions by which the poses are uncertain: what the winner leaves open, and where the others
/// place the views instead, each with the root of its probability.
ViewMotions motions_of_views(const PoseRound& round,
                             const PosePosterior& won,
                             const PoseRound& scored,
                             const ScoredCause& winner) {
  constexpr double kLeast = 1e-3;  // probability
  std::vector<Eigen::VectorXd> columns;
  // Errors that the views have in common are those of views, not of their regions.
  const double wider = std::sqrt(static_cast<double>(kRegionsPerView));
  for (Eigen::Index i = 0; i < won.factor.cols(); ++i)
    columns.emplace_back(wider * won.factor.col(i));
  const Eigen::VectorXd own = scored.posterior(winner.best).motion;
  for (std::size_t i = 0; i < scored.causes.size(); ++i) {
    const ScoredCause& other = scored.causes[i];
    if (other.cause == winner.cause) continue;
    const double odds = std::exp(std::min(0.0, other.log_odds - winner.log_odds));
    if (odds > kLeast)
      columns.emplace_back(std::sqrt(odds / (1.0 + odds)) * (scored.motions[i] - own));
  }
  ViewMotions motions(
      round.poses.size(),
      Eigen::Matrix<double, 6, Eigen::Dynamic>(6, static_cast<Eigen::Index>(columns.size())));
  for (std::size_t view = 0; view < motions.size(); ++view) {
    for (std::size_t i = 0; i < columns.size(); ++i)
      motions[view].col(static_cast<Eigen::Index>(i)) =
          columns[i].segment<6>(static_cast<Eigen::Index>(6 * view));
  }
  return motions;
}

/// The poses by the winner, refined with many surfels.
CorrectedPoses correct(const PoseRound& scored,
                       const ScoredCause& winner,
                       const Registration& work,
                       std::size_t dense) {
  constexpr int kTurns = 3;  // each finds the pairs again
  const SurfelLists surfels = pick_all_surfels(scored.bundle.maps, dense);
  PoseRound round{.bundle = scored.bundle, .chart = scored.chart, .poses = scored.poses};
  round.chart.setting.rig_changes = 0;
  PosePosterior found;
  const auto views = static_cast<Eigen::Index>(6 * round.poses.size());
  TableState state = scored.chart.state;
  found = scored.posterior(winner.best);
  for (int turn = 0; turn < kTurns; ++turn) {
    work.run.check();
    round.poses = round.chart.poses_at(found.motion);
    state = round.chart.table_at(work.bundle.given, found.table);
    round.chart = make_chart(round.bundle, work.surfels, state, work.options);
    round.sums = sum_poses(round.bundle, surfels, {round.poses, nullptr});
    NormalEquations data = from_stated(round.sums.all(), round.chart.motions_to(round.poses));
    data.hessian *= scored.noise.scale * scored.sums.weight / round.sums.weight;
    data.gradient *= scored.noise.scale * scored.sums.weight / round.sums.weight;
    round.noise = scored.noise;
    round.evidence.emplace(std::move(data), round.chart.table);
    found = round.evidence->posterior(motions_of(winner.best, round.chart.setting, views));
  }
  round.poses = round.chart.poses_at(found.motion);
  state = round.chart.table_at(work.bundle.given, found.table);
  const PoseSums last = sum_poses(round.bundle, surfels, {round.poses, nullptr});
  // What no overlap determines must not count as a contradiction: the margin is that of the noise.
  round.bundle.gate_mm = std::max(round.bundle.gate_mm, 3.0 * round.bundle.min_gate_mm);
  const PoseSums wide = sum_poses(round.bundle, work.surfels, {round.poses, nullptr});
  return {state, round.poses, last.fit, wide.fit, motions_of_views(round, found, scored, winner)};
}

bool moves_views(PoseCause cause) {
  switch (cause) {
    case PoseCause::Turned:
    case PoseCause::AnglesScaled:
    case PoseCause::PartMoved:
    case PoseCause::PartMovedTwice:
    case PoseCause::PartDrift:
    case PoseCause::Wobble:
      return true;
    default:
      return false;
  }
}

}  // namespace

ExplainedPoses explain_poses(const Registration& work,
                             const TurntableStations& given,
                             std::size_t dense) {
  ExplainedPoses all;
  const PoseChart chart = make_chart(work.bundle, work.surfels, work.bundle.state, work.options);
  if (!is_suspicious(work, chart)) return all;
  PoseRound round{.bundle = work.bundle, .chart = chart, .poses = chart.from};
  round.bundle.gate_mm = work.reach_mm;
  free_poses(round.bundle, work.surfels, round.poses, round.chart, work.options, work.run);
  std::optional<DriftModel> model;
  if (given.rig != nullptr && given.pattern != nullptr) {
    model.emplace(*given.rig, RefineRigOptions{}, chart.setting.distance_mm);
    round.rig_at = Eigen::VectorXd::Zero(2 * model->count());
    round.rig = rig_changes(*model, *given.pattern, chart.setting.times, round.rig_at);
    round.chart.setting.rig_changes = model->count();
  }
  round.sums =
      sum_poses(round.bundle, work.surfels, {round.poses, round.rig ? &*round.rig : nullptr});
  score(round);
  const std::size_t first = winner_of(round);
  const ScoredCause winner = round.causes[first];
  PoseExplanation& explanation = all.explanation;
  measure(explanation, round, winner);
  if (winner.cause == PoseCause::AsStated || explanation.effect_mm < noticeable_mm(round))
    return {};
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
  explanation.log_odds_stated = winner.log_odds - round.log_odds_of(PoseCause::AsStated);
  explanation.decided = explanation.log_odds > kNamed && explanation.log_odds_stated > kNamed &&
                        predicts(round, winner.best);
  if (winner.cause == PoseCause::Rig || winner.cause == PoseCause::RigDrift) {
    const Eigen::VectorXd changes = round.motions[first].tail(2 * model->count());
    const bool drifts = winner.cause == PoseCause::RigDrift;
    explanation.terms =
        terms_of(*model, drifts ? changes.tail(model->count()) : changes.head(model->count()));
    if (drifts) all.rigs = rigs_of_views(*model, chart.setting.times, changes);
  }
  if (moves_views(winner.cause)) all.corrected = correct(round, winner, work, dense);
  const auto names = [&](std::size_t view) { return work.name_of(view); };
  explanation.text = describe(explanation, names);
  explanation.remedy = remedy_of(explanation);
  return all;
}

}  // namespace frangia
