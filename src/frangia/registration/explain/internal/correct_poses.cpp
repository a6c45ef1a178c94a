#include "frangia/registration/explain/internal/correct_poses.h"

#include <algorithm>
#include <utility>

#include "frangia/registration/explain/internal/spread_of_causes.h"

namespace frangia {
namespace {

/// The most probable poses by one cause; each turn finds the pairs again.
struct CauseFit {
  const Registration& work;
  const PoseRound& scored;
  const CauseHypothesis& cause;
  PoseRound round;
  TableState state;
  PosePosterior found;

  CauseFit(const Registration& of, const PoseRound& at, const CauseHypothesis& by)
      : work(of),
        scored(at),
        cause(by),
        round{.bundle = of.bundle, .chart = at.chart, .poses = at.poses},
        state(at.chart.state),
        found(at.posterior(by)) {
    round.bundle.gate_mm = at.bundle.gate_mm;
    if (cause.exact_table) round.chart = round.chart.with_exact_table();
    move();
  }

  void move() {
    round.poses = round.chart.poses_at(found.motion);
    state = round.chart.table_at(work.bundle.given, found.table);
  }

  void refine(const SurfelLists& surfels) {
    round.chart =
        make_chart(round.bundle, work.surfels, state, scored.chart.setting.times, work.options);
    if (cause.exact_table) round.chart = round.chart.with_exact_table();
    round.sums = sum_poses(round.bundle, surfels, {round.poses, nullptr});
    NormalEquations data = from_stated(round.sums.all(), round.chart.motions_to(round.poses));
    // The surfels are more, and not more independent.
    const double share = scored.noise.scale * scored.sums.weight / round.sums.weight;
    data.hessian *= share;
    data.gradient *= share;
    if (!round.bundle.ties.empty()) {
      data.add(from_stated(sum_pose_ties(round.bundle, {round.poses, nullptr}),
                           round.chart.motions_to(round.poses)));
    }
    round.evidence.emplace(std::move(data), round.chart.table);
    const auto views = static_cast<Eigen::Index>(6 * round.poses.size());
    found = round.evidence->posterior(motions_of(cause, round.chart.setting, views));
    move();
  }
};

}  // namespace

bool moves_views(PoseCause cause) {
  switch (cause) {
    case PoseCause::Turned:
    case PoseCause::AnglesScaled:
    case PoseCause::PartMoved:
    case PoseCause::PartMovedTwice:
    case PoseCause::ViewsMoved:
    case PoseCause::PartDrift:
    case PoseCause::TableMoved:
    case PoseCause::Wobble:
    case PoseCause::Unexplained:
      return true;
    default:
      return false;
  }
}

CorrectedPoses correct_poses(const PoseRound& scored,
                             const ScoredCause& winner,
                             const Registration& work,
                             std::size_t dense) {
  constexpr int kTurns = 3;
  CauseFit fit(work, scored, winner.best);
  const SurfelLists surfels = pick_all_surfels(fit.round.bundle.maps, dense);
  for (int turn = 0; turn < kTurns; ++turn) {
    work.run.check();
    fit.refine(surfels);
  }
  Bundle& bundle = fit.round.bundle;
  const PoseSums last = sum_poses(bundle, surfels, {fit.round.poses, nullptr});
  // What no overlap determines must not count as a contradiction: the margin is that of the noise.
  bundle.gate_mm = std::max(bundle.gate_mm, 3.0 * bundle.min_gate_mm);
  const PoseSums wide = sum_poses(bundle, work.surfels, {fit.round.poses, nullptr});
  const PoseSpread spread =
      spread_of_winner(scored, fit.found, work) + spread_of_causes(scored, winner, work);
  return {fit.state, fit.round.poses, last.fit, wide.fit, spread.of_views()};
}

}  // namespace frangia
