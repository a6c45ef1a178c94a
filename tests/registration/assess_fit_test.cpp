#include "frangia/registration/internal/assess_fit.h"

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/registration/internal/assess_observability.h"

namespace frangia {
namespace {

/// Sums of views with these numbers of matched and observed surfels, and no comparisons yet.
BundleSums counted_sums(std::vector<std::size_t> matched, std::vector<std::size_t> observed) {
  BundleSums sums;
  sums.regions.resize(kRegionsPerView * matched.size() * matched.size());
  sums.matched = std::move(matched);
  sums.observed = std::move(observed);
  return sums;
}

SurfelLists lists_of(const std::vector<std::size_t>& sizes) {
  SurfelLists lists;
  for (const std::size_t size : sizes)
    lists.emplace_back(size);
  return lists;
}

TEST(RmsOf, IsTheRootOfTheMeanSquare) {
  EXPECT_DOUBLE_EQ(rms_of({3.0F, 4.0F, 0.0F, 0.0F}), 2.5);
  EXPECT_EQ(rms_of({}), 0.0);
}

TEST(OverlapOf, IsTheShareOfTheSurfelsThatMatch) {
  EXPECT_DOUBLE_EQ(overlap_of(counted_sums({30, 10}, {50, 50}), lists_of({60, 100})), 0.25);
  EXPECT_EQ(overlap_of(counted_sums({0, 0}, {0, 0}), lists_of({0, 0})), 0.0);
}

TEST(FindOutliers, AreViewsThatMatchMuchLessThanTheMedianView) {
  // Shares of 0.8, 0.5, 0.31, 0.9, and 1 for a view that sees no other; the median is 0.8.
  const BundleSums sums = counted_sums({80, 50, 31, 90, 0}, {100, 100, 100, 100, 0});
  EXPECT_EQ(find_outliers(sums, 0.35), (std::vector<std::size_t>{}));
  EXPECT_EQ(find_outliers(sums, 0.4), (std::vector<std::size_t>{2}));
  EXPECT_EQ(find_outliers(sums, 0.7), (std::vector<std::size_t>{1, 2}));
}

TEST(ContradictionOf, IsTheLargestShareOfViolationsOfAViewWithEnoughComparisons) {
  BundleSums sums = counted_sums({0, 0, 0}, {0, 0, 0});
  const auto tally = [&](std::size_t from, std::size_t to, std::size_t region) -> PairTally& {
    return sums.regions[kRegionsPerView * (3 * from + to) + region];
  };
  tally(0, 1, 0) = {.agree = 60, .violations = 3};
  tally(0, 1, 3) = {.agree = 30, .violations = 2};
  tally(1, 0, 1) = {.agree = 5, .violations = 0};
  EXPECT_NEAR(contradiction_of(sums, lists_of({1000, 1000, 1000})), 0.05, 1e-12);
  EXPECT_EQ(contradiction_of(sums, lists_of({2001, 2001, 1000})), 0.0) << "less than a twentieth";
  tally(2, 1, 2) = {.agree = 40, .violations = 10};
  EXPECT_NEAR(contradiction_of(sums, lists_of({1000, 1000, 900})), 0.2, 1e-12);
  EXPECT_NEAR(contradiction_of(sums, lists_of({1000, 1000, 1001})), 0.1, 1e-12) << "15 of 150";
}

TEST(ContradictingView, IsTheOneWithoutWhichNoViewsContradictEachOther) {
  constexpr std::size_t kViews = 4;
  BundleSums sums = counted_sums({0, 0, 0, 0}, {0, 0, 0, 0});
  const auto tally = [&](std::size_t from, std::size_t to) -> PairTally& {
    return sums.regions[kRegionsPerView * (kViews * from + to)];
  };
  const SurfelLists lists = lists_of({1000, 1000, 1000, 1000});
  for (std::size_t from = 0; from < kViews; ++from)
    for (std::size_t to = 0; to < kViews; ++to)
      if (from != to) tally(from, to) = {.agree = 300, .violations = 1};
  tally(2, 1).violations = 30;
  EXPECT_EQ(contradicting_view(sums, lists, 0.01), std::nullopt) << "1 or 2";
  tally(3, 2).violations = 30;
  EXPECT_EQ(contradicting_view(sums, lists, 0.01), 2U);
  tally(3, 0).violations = 30;
  EXPECT_EQ(contradicting_view(sums, lists, 0.01), std::nullopt) << "two views";
}

TEST(DisagreeingView, IsTheOneThatIsOffFromAllOthersWhichAgree) {
  constexpr std::size_t kViews = 4;
  BundleSums sums = counted_sums({0, 0, 0, 0}, {0, 0, 0, 0});
  const auto put = [&](std::size_t from, std::size_t to, double over_sigma) {
    PairTally& pair = sums.regions[kRegionsPerView * (kViews * from + to)];
    pair.weight = 100.0;
    pair.weighted_mm = over_sigma * 10.0;
  };
  for (std::size_t from = 0; from < kViews; ++from)
    for (std::size_t to = 0; to < kViews; ++to)
      if (from != to) put(from, to, 1.0);
  EXPECT_EQ(disagreeing_view(sums), std::nullopt) << "noise";
  put(3, 0, 5.0);
  EXPECT_EQ(disagreeing_view(sums), std::nullopt) << "0 or 3";
  put(3, 1, -5.0);
  put(3, 2, 5.0);
  EXPECT_EQ(disagreeing_view(sums), 3U);
  put(0, 1, 9.0);
  EXPECT_EQ(disagreeing_view(sums), std::nullopt) << "0 and 1, too";
}

/// A bundle of three views in one setup: two tilts, two shifts and two angles.
Bundle three_views() {
  Bundle bundle{.maps = {},
                .model = FastCameraModel(CameraModel{}),
                .given = {},
                .state = {},
                .prior_sigma = {}};
  bundle.state.angles_rad = {0.0, 1.0, 2.0};
  bundle.prior_sigma.resize(6);
  bundle.prior_sigma << 0.01, 0.01, 2.0, 2.0, 0.003, 0.003;
  bundle.systematic_mm = 1e-9;
  bundle.pairs = all_view_pairs(3);
  return bundle;
}

/// Information of the pairs as multiples of the prior's.
BundleSums sums_with_gain(const Bundle& bundle, const std::vector<double>& gain) {
  BundleSums sums;
  sums.distances_mm = {0.1F, 0.2F, 0.3F};
  sums.hessian = Eigen::MatrixXd::Zero(6, 6);
  for (Eigen::Index i = 0; i < 6; ++i)
    sums.hessian(i, i) = gain[static_cast<std::size_t>(i)] / std::pow(bundle.prior_sigma[i], 2);
  return sums;
}

TEST(AssessObservability, ComparesTheInformationOfThePairsWithThePrior) {
  const Bundle bundle = three_views();
  const BundleSums sums = sums_with_gain(bundle, {24, 99, 15, 399, 35, 80});
  const SurfelLists surfels = lists_of({10, 10, 10});
  RegistrationReport report;
  assess_observability(report, bundle, sums, surfels, 100.0);
  EXPECT_NEAR(report.weakest, 4.0, 1e-9);
  EXPECT_NEAR(report.condition, 5.0, 1e-9);
  // Tilts of 0.01 rad at an arm of 100 mm by 5 and 10; shifts of 2 mm by 4 and 20.
  EXPECT_NEAR(report.axis_sigma_mm, 0.5, 1e-9);
  EXPECT_TRUE(report.undetermined.empty());
  assess_observability(report, bundle, sums, surfels, 300.0);
  EXPECT_NEAR(report.axis_sigma_mm, 0.6, 1e-9) << "the tilt at a longer arm";
}

TEST(AssessObservability, NamesWhatTheViewsDetermineLessThanThreeTimesAsWellAsThePrior) {
  const Bundle bundle = three_views();
  const auto undetermined = [&](const std::vector<double>& gain,
                                const std::vector<std::size_t>& surfels = {10, 10, 10}) {
    RegistrationReport report;
    assess_observability(report, bundle, sums_with_gain(bundle, gain), lists_of(surfels), 100.0);
    return report.undetermined;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(undetermined({9.1, 50, 9.1, 50, 9.1, 50}), Names{});
  EXPECT_EQ(undetermined({50, 8.9, 50, 50, 50, 50}), Names{"the tilt of the axis"});
  EXPECT_EQ(undetermined({50, 50, 50, 8.9, 50, 50}), Names{"the position of the axis"});
  EXPECT_EQ(undetermined({50, 50, 50, 50, 50, 8.9}), Names{"the angles of the views"});
  EXPECT_EQ(undetermined({0, 0, 0, 0, 0, 0}).size(), 3U);
  EXPECT_EQ(undetermined({50, 50, 50, 50, 50, 0}, {10, 10, 0}), Names{}) << "of a view left out";
}

TEST(EffectiveWeight, CountsThePairsOfTwoViewsUpToTheirCommonError) {
  Bundle bundle = three_views();  // six comparisons
  BundleSums sums;
  sums.distances_mm.assign(1000, 0.02F);  // a scatter of 0.02 * 1.4826
  bundle.systematic_mm = 0.005;
  EXPECT_NEAR(
      effective_weight(bundle, sums), 6.0 * std::pow(0.02 * 1.4826 / 0.005, 2) / 1000.0, 1e-6);
  bundle.systematic_mm = 0.001;
  EXPECT_EQ(effective_weight(bundle, sums), 1.0);
}

}  // namespace
}  // namespace frangia
