#include "frangia/registration/internal/explain_poses.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "frangia/core/statistics.h"
#include "frangia/geometry/robust_gauss_newton.h"
#include "frangia/registration/explain/internal/cause_motions.h"
#include "frangia/registration/explain/internal/correct_poses.h"
#include "frangia/registration/explain/internal/describe_explanation.h"
#include "frangia/registration/explain/internal/measure_cause.h"
#include "frangia/registration/explain/internal/scored_round.h"
#include "frangia/registration/explain/internal/spread_of_causes.h"
#include "frangia/registration/explain/internal/time_profiles.h"
#include "frangia/registration/internal/assess_fit.h"
#include "frangia/registration/internal/table_state.h"
#include "frangia/registration/refine_rig.h"

namespace frangia {
namespace {

/// Scores the hypotheses on the pairs of the views in the poses of a round.
///
/// @shape    `rig_at`: changes of the rig that measured the surfels, as `changes_of_views` has them
void score_pairs(PoseRound& round,
                 const SurfelLists& surfels,
                 const TurntableStations& given,
                 const std::optional<DriftModel>& model,
                 const Eigen::VectorXd& rig_at) {
  sum_pairs(round, surfels, given, model, rig_at);
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

/// Whether views that are moved by themselves fit noticeably better than the table places them, or
/// the table does so only by changes that are not to be expected, of which there is a more probable
/// cause. Else they would slide along faces that do not hold them.
bool fits_better_free(const PoseRound& round) {
  const ScoredCause& cause = round.causes[most_probable_of(round)];
  if (is_beyond_prior(round) && cause.cause != PoseCause::AsStated && cause.log_odds > kNamed)
    return true;
  const PosePosterior free =
      round.posterior({PoseCause::Unexplained, {}, 0.001 * round.chart.setting.distance_mm, 0.0});
  return round.effect_mm(free.motion - round.stated()) > noticeable_mm(round);
}

const ScoredCause& as_stated(const PoseRound& round) {
  return *std::find_if(round.causes.begin(), round.causes.end(), [](const ScoredCause& cause) {
    return cause.cause == PoseCause::AsStated;
  });
}

/// Views as the table places them that was refined with their points as rigs of their own measure
/// them, or as the table and a knock do.
struct PlacedViews {
  Eigen::VectorXd rig_at;  ///< changes of the rig, as `changes_of_views` has them
  Bundle bundle;
  SurfelLists surfels;
  std::vector<Eigen::Isometry3d> object_from_rig{};  ///< of each view
  double apart_mm = 0.0;  ///< median distance of the pairs within the reach
  std::size_t pairs = 0;

  void place_by_table() {
    object_from_rig.clear();
    for (const Eigen::Isometry3d& pose : object_poses(bundle.state))
      object_from_rig.push_back(pose.inverse());
  }
  void compare(double reach_mm) {
    Bundle open = bundle;
    open.gate_mm = reach_mm;
    const BundleSums sums = sum_poses(open, surfels, {object_from_rig, nullptr}).fit;
    apart_mm = static_cast<double>(median(sums.distances_mm));
    pairs = sums.distances_mm.size();
  }
};

PlacedViews placed_as_stated(const Registration& work, Eigen::VectorXd rig_at) {
  PlacedViews placed{std::move(rig_at), work.bundle, work.surfels};
  placed.place_by_table();
  placed.compare(work.reach_mm);
  return placed;
}

/// By a cause of a round that changes the rig.
PlacedViews placed_by(const Registration& work,
                      const TurntableStations& given,
                      const DriftModel& model,
                      const PoseRound& round,
                      std::size_t cause) {
  const Eigen::VectorXd& motion = round.motions[cause];
  PlacedViews placed{motion.tail(round.rig_at.size()), work.bundle, {}};
  const Eigen::MatrixXd basis = basis_of_profiles(times_of(work.stations));
  displace_views(
      placed.bundle.maps, *given.rig, rigs_of_views(model, basis, placed.rig_at), *given.pattern);
  placed.surfels = pick_all_surfels(placed.bundle.maps, surfels_to_explain(work.views.size()));
  placed.bundle.gate_mm = work.reach_mm;
  if (round.causes[cause].cause == PoseCause::RigMoved) {
    const PosePosterior found = round.posterior(round.causes[cause].best);
    placed.bundle.state = round.chart.table_at(work.bundle.given, found.table);
    placed.object_from_rig = round.chart.poses_at(motion);
  } else {
    placed.bundle.state = placed.bundle.given;
    optimize_bundle(placed.bundle, placed.surfels, work.options.max_iterations, work.run);
    placed.place_by_table();
  }
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
  PoseRound round{.bundle = placed.bundle, .chart = chart, .poses = placed.object_from_rig};
  if (poses == ScoredPoses::Free) {
    round.bundle.gate_mm = work.reach_mm;
    free_poses(round.bundle, placed.surfels, round.poses, round.chart, work.options, work.run);
  } else {
    // Surfaces that do not belong together lie within the reach, too.
    const double closed_mm = std::max(round.bundle.min_gate_mm, gate_of_median(placed.apart_mm));
    round.bundle.gate_mm = std::min(work.reach_mm, closed_mm);
  }
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
    PlacedViews placed = placed_by(work, given, model, round, i);
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

/// The hypotheses at the rig that is the winner of those as placed; none where it is not, or where
/// the table places the views hardly better with it.
std::optional<PoseRound> scored_with_rig(const Registration& work,
                                         const TurntableStations& given,
                                         const DriftModel& model,
                                         const PoseRound& as_placed) {
  if (!changes_rig(as_placed.causes[winner_of(as_placed)].cause)) return std::nullopt;
  PlacedViews placed = placed_as_stated(work, as_placed.rig_at);
  RoundOfViews found =
      at_found_rig(work, given, model, {as_placed, std::move(placed)}, ScoredPoses::OfTable);
  if (found.placed.rig_at.isZero()) return std::nullopt;
  return std::move(found.round);
}

/// The hypotheses where every view fits by itself.
PoseRound scored_where_free(const Registration& work,
                            const TurntableStations& given,
                            const std::optional<DriftModel>& model,
                            const PoseChart& chart) {
  PlacedViews placed = placed_as_stated(work, rig_as_stated(model, chart));
  PoseRound round = scored_round(work, given, model, placed, ScoredPoses::Free);
  if (!model) return round;
  RoundOfViews free{std::move(round), std::move(placed)};
  return at_found_rig(work, given, *model, std::move(free), ScoredPoses::Free).round;
}

/// Without the causes that change the rig.
PoseRound without_rig(PoseRound round) {
  for (std::size_t i = round.causes.size(); i-- > 0;) {
    if (!changes_rig(round.causes[i].cause)) continue;
    round.causes.erase(round.causes.begin() + static_cast<std::ptrdiff_t>(i));
    round.motions.erase(round.motions.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return round;
}

PoseChart chart_of(const Registration& work) {
  return make_chart(
      work.bundle, work.surfels, work.bundle.state, times_of(work.stations), work.options);
}

std::optional<DriftModel> drift_of(const TurntableStations& given, const PoseChart& chart) {
  if (given.rig == nullptr || given.pattern == nullptr) return std::nullopt;
  return DriftModel(*given.rig, RefineRigOptions{}, chart.setting.distance_mm);
}

}  // namespace

bool leaves_nothing_to_explain(const Registration& work, const TurntableStations& given) {
  const PoseChart chart = chart_of(work);
  const PoseRound placed = scored_as_placed(work, given, drift_of(given, chart), chart);
  return !changes_rig(placed.causes[winner_of(placed)].cause) && !fits_better_free(placed);
}

ExplainedPoses explain_poses(const Registration& work,
                             const TurntableStations& given,
                             std::size_t dense) {
  ExplainedPoses all;
  const PoseChart chart = chart_of(work);
  const std::optional<DriftModel> model = drift_of(given, chart);
  PoseRound placed = scored_as_placed(work, given, model, chart);
  // Views of a wrong rig slide off each other once they are free: its hypothesis goes first.
  std::optional<PoseRound> again;
  if (model) again = scored_with_rig(work, given, *model, placed);
  RigCovariance open_as_placed;
  if (!again) {
    if (model) open_as_placed = open_rig(placed, *model, std::nullopt);
    placed = without_rig(std::move(placed));
  }
  if (!again && fits_better_free(placed)) again = scored_where_free(work, given, model, chart);
  if (!again) {
    all.rig_open = std::move(open_as_placed);
    all.spread = spread_of_causes(placed, as_stated(placed), work).of_views();
    return all;
  }
  const PoseRound& round = *again;
  const std::size_t first = winner_of(round);
  const ScoredCause winner = round.causes[first];
  PoseExplanation& explanation = all.explanation;
  explanation = explanation_by(round, first, work);
  if (winner.cause == PoseCause::AsStated || !is_noticeable(round, first)) {
    explanation = {};
    all.spread = spread_of_causes(round, as_stated(round), work).of_views();
    if (model) all.rig_open = open_rig(round, *model, std::nullopt);
    return all;
  }
  if (changes_rig(winner.cause)) {
    const Eigen::VectorXd of_rig = round.motions[first].tail(round.rig_at.size());
    const Eigen::MatrixXd changes = changes_of_views(of_rig, round.rig->basis);
    const bool drifts = winner.cause != PoseCause::Rig;
    if (winner.cause != PoseCause::RigMoved) explanation.terms = terms_of(*model, changes, drifts);
    if (drifts && explanation.decided) {
      all.rigs = rigs_of_views(*model, round.rig->basis, of_rig);
      all.fits = fits(round.sums.fit, work);
      const PoseSpread own = spread_of_winner(round, round.posterior(winner.best), work);
      all.spread = (own + spread_of_causes(round, winner, work)).of_views();
    }
  }
  if (moves_views(winner.cause)) {
    all.corrected = correct_poses(round, winner, work, dense);
    all.fits = fits(all.corrected->wide, work);
  }
  const bool by_table = all.rigs.empty() && changes_rig(winner.cause);
  if (!all.corrected && all.spread.empty()) {
    all.spread = spread_of_causes(round, by_table ? as_stated(round) : winner, work).of_views();
  }
  if (model) {
    const auto applied = all.rigs.empty() ? std::nullopt : std::optional(winner.cause);
    all.rig_open = open_rig(round, *model, applied);
  }
  const auto names = [&](std::size_t view) { return work.name_of(view); };
  explanation.text = describe(explanation, names);
  explanation.remedy = remedy_of(explanation, work.options.wrong_rig);
  return all;
}

}  // namespace frangia
