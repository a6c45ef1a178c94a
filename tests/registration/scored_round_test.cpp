// Which of the scored causes wins.
#include "frangia/registration/explain/internal/scored_round.h"

#include <utility>

#include <gtest/gtest.h>

namespace frangia {
namespace {

constexpr double kPairsWeight = 1e10;  // in units of their variance
constexpr Eigen::Index kScoredViews = 3;
constexpr Eigen::Index kScoredUnknowns = 6 * kScoredViews;
constexpr double kTableSigma_rad = 0.001;

/// Three views whose pairs show by as much how each of them is turned or shifted. They agree once
/// the later two are turned about the axis by `turn_rad`, which the table does by its angles.
PoseRound turned_views(double turn_rad) {
  PoseRound round{.bundle = {{}, FastCameraModel(CameraModel{}), {}, {}, {}}, .chart = {}};
  PoseSetting& setting = round.chart.setting;
  setting.views = static_cast<std::size_t>(kScoredViews);
  setting.angles_rad = {0.0, 1.0, 2.0};
  setting.times = {-0.5, 0.0, 0.5};
  setting.center_mm.setZero();
  setting.radius_mm = 10.0;
  round.chart.exact_share = Eigen::VectorXd::Ones(kScoredViews + 3);
  round.chart.table = Eigen::MatrixXd::Zero(kScoredUnknowns, kScoredViews + 3);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(kScoredUnknowns);
  for (Eigen::Index view = 1; view < kScoredViews; ++view) {
    round.chart.table(6 * view + 2, 3 + view) = kTableSigma_rad;
    right[6 * view + 2] = turn_rad;
  }
  NormalEquations data{kPairsWeight * Eigen::MatrixXd::Identity(kScoredUnknowns, kScoredUnknowns),
                       -kPairsWeight * right};
  round.evidence.emplace(data, round.chart.table);
  round.exact.emplace(data, round.chart.table);
  round.sums.halves = {data, data};
  for (NormalEquations& half : round.sums.halves)
    half.hessian *= 0.5;
  round.sums.weight = kPairsWeight;
  round.noise.scatter_mm = 0.001;
  round.noise.shared_mm = 0.0001;
  return round;
}

void add_cause(PoseRound& round, double log_odds, CauseHypothesis hypothesis) {
  hypothesis.log_odds = log_odds;
  round.motions.push_back(round.posterior(hypothesis).motion);
  round.causes.push_back({hypothesis.cause, log_odds, std::move(hypothesis)});
}

TEST(ScoredRound, NamesWhatTurnedTheViewsThoughAHardlyNoticeableCauseIsMoreProbable) {
  PoseRound round = turned_views(50.0 * kTableSigma_rad);
  add_cause(round, 500.0, {PoseCause::ViewMoved, {1}, 1e-6});
  add_cause(round, 200.0, {PoseCause::Turned, {1}, 1.0});
  add_cause(round, 0.0, {PoseCause::AsStated, {}, 0.0});
  EXPECT_TRUE(is_beyond_prior(round));
  EXPECT_FALSE(is_noticeable(round, 0)) << effect_of(round, 0);
  EXPECT_TRUE(is_noticeable(round, 1)) << effect_of(round, 1);
  EXPECT_EQ(winner_of(round), 1U);
}

TEST(ScoredRound, NoticesWhatThePairsHaveInCommonOnlyWhereRegionsTellIt) {
  PoseRound round = turned_views(0.0);
  round.noise = {.scatter_mm = 0.03, .shared_mm = 0.002, .left_share = 1.0};
  EXPECT_NEAR(noticeable_mm(round), 0.006, 1e-12) << "a fifth of the scatter";
  round.noise.left_share = 0.36;  // of the regions: the others were fitted
  EXPECT_NEAR(noticeable_mm(round), 2.5 * 0.002 / 0.6, 1e-12);
  round.noise.left_share = 0.1;
  EXPECT_NEAR(noticeable_mm(round), 0.75 * 0.03, 1e-12);
}

TEST(ScoredRound, NamesNothingWhereNoCauseIsNoticeable) {
  PoseRound round = turned_views(0.5 * kTableSigma_rad);
  add_cause(round, 500.0, {PoseCause::ViewMoved, {1}, 1e-6});
  add_cause(round, 0.0, {PoseCause::AsStated, {}, 0.0});
  EXPECT_FALSE(is_beyond_prior(round));
  EXPECT_EQ(winner_of(round), 1U);
}

}  // namespace
}  // namespace frangia
