#include "frangia/phase/spatial/unwrap_spatially.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"
#include "frangia/phase/spatial/find_residues.h"
#include "frangia/phase/spatial/internal/cut_mask.h"

namespace frangia {
namespace {

/// A wrapped map of `phase(x, y)`; NaN is missing.
template <typename PhaseOf>
WrappedPhase wrapped_map(int width, int height, const PhaseOf& phase, double noise_rad = 0.0) {
  std::mt19937 generator(9);
  std::normal_distribution<double> noise(0.0, 1.0);
  WrappedPhase map{.pattern = {},
                   .phase_rad = Image<float>(width, height, kMissing),
                   .sigma_rad = Image<float>(width, height, kMissing),
                   .modulation_counts = Image<float>(width, height, 50.0F),
                   .mean_counts = Image<float>(width, height, 80.0F),
                   .status = Image<PixelStatus>(width, height, PixelStatus::Unmodulated)};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double value = phase(x, y) + noise_rad * noise(generator);
      if (std::isnan(value)) continue;
      map.phase_rad(x, y) = static_cast<float>(wrap_rad(value));
      map.sigma_rad(x, y) = static_cast<float>(std::max(noise_rad, 0.01));
      map.status(x, y) = PixelStatus::Measured;
    }
  }
  return map;
}

/// Whether the phase differs from the truth by one whole number of turns per region.
template <typename PhaseOf>
::testing::AssertionResult is_true_but_for_turns(const RelativePhase& found,
                                                 const PhaseOf& truth,
                                                 double tolerance) {
  std::map<int, int> turns;
  for (int y = 0; y < found.phase_rad.height(); ++y) {
    for (int x = 0; x < found.phase_rad.width(); ++x) {
      if (found.region(x, y) < 0) continue;
      const double off = (found.phase_rad(x, y) - truth(x, y)) / kTwoPi;
      const int whole = static_cast<int>(std::lround(off));
      const int expected = turns.emplace(found.region(x, y), whole).first->second;
      if (whole != expected || std::abs(off - whole) * kTwoPi > tolerance) {
        return ::testing::AssertionFailure()
               << "at " << x << ", " << y << ": off by " << off << " turns";
      }
    }
  }
  return ::testing::AssertionSuccess();
}

double dome(int x, int y) {
  return 30.0 - 0.002 * ((x - 90) * (x - 90) + (y - 70) * (y - 70));
}

TEST(UnwrapSpatially, RecoversASmoothSurfaceAsOneRegion) {
  const RelativePhase found = unwrap_spatially(wrapped_map(180, 140, dome, 0.05));
  EXPECT_EQ(found.region_count, 1);
  EXPECT_TRUE(is_true_but_for_turns(found, dome, 0.4));
}

TEST(UnwrapSpatially, KeepsACreaseInOneRegion) {
  const auto roof = [](int x, int) { return x < 60 ? 0.15 * x : 9.0 - 0.20 * (x - 60); };
  const RelativePhase found = unwrap_spatially(wrapped_map(120, 80, roof, 0.02));
  EXPECT_EQ(found.region_count, 1);
  EXPECT_TRUE(is_true_but_for_turns(found, roof, 0.2));
}

TEST(UnwrapSpatially, NeverJoinsAcrossAStepOfMoreThanHalfAFringe) {
  // The step varies from 2 to 9 rad; where it is 2 pi, the wrapped phase looks smooth.
  const auto step = [](int x, int y) { return 0.1 * x + (x < 100 ? 0.0 : 2.0 + 0.05 * y); };
  const RelativePhase found = unwrap_spatially(wrapped_map(200, 140, step, 0.03));
  EXPECT_GE(found.region_count, 2);
  EXPECT_TRUE(is_true_but_for_turns(found, step, 0.3));
}

TEST(UnwrapSpatially, GivesEveryConnectedComponentItsOwnRegion) {
  const auto islands = [](int x, int) { return x / 50 % 2 == 0 ? 0.2 * x : std::nan(""); };
  const RelativePhase found = unwrap_spatially(wrapped_map(250, 60, islands));
  EXPECT_EQ(found.region_count, 3);
  EXPECT_TRUE(is_true_but_for_turns(found, islands, 1e-4));
}

/// Fraction of the measured pixels whose order differs from the majority of their region.
template <typename PhaseOf>
double wrong_share(const RelativePhase& found, const PhaseOf& truth) {
  std::map<int, std::map<int, int>> votes;
  for (int y = 0; y < found.phase_rad.height(); ++y) {
    for (int x = 0; x < found.phase_rad.width(); ++x) {
      if (found.region(x, y) < 0) continue;
      const double off = (found.phase_rad(x, y) - truth(x, y)) / kTwoPi;
      ++votes[found.region(x, y)][static_cast<int>(std::lround(off))];
    }
  }
  double all = 0.0;
  double right = 0.0;
  for (const auto& [region, orders] : votes) {
    int most = 0;
    for (const auto& [order, count] : orders) {
      all += count;
      most = std::max(most, count);
    }
    right += most;
  }
  return 1.0 - right / all;
}

TEST(UnwrapSpatially, TheDefaultIsAtLeastAsAccurateAsThePublishedMethods) {
  // Noise with which about one difference in several hundred exceeds half a fringe.
  const auto truth = [](int x, int y) {
    return 0.0006 * ((x - 300) * (x - 300) + (y - 200) * (y - 200));
  };
  const WrappedPhase map = wrapped_map(600, 400, truth, 0.6);
  const auto share = [&](SpatialMethod method) {
    return wrong_share(unwrap_spatially(map, {.method = method}), truth);
  };
  const double runs = share(SpatialMethod::RunMerging);
  const double grown = share(SpatialMethod::QualityGuided);
  const double sorted = share(SpatialMethod::ReliabilitySorted);
  EXPECT_LE(runs, std::min(grown, sorted) + 1e-4) << "run-merging " << runs << ", quality-guided "
                                                  << grown << ", reliability-sorted " << sorted;
  EXPECT_LT(sorted, 0.01);
}

TEST(UnwrapSpatially, EveryMethodRecoversASmoothSurface) {
  for (const SpatialMethod method : {SpatialMethod::RunMerging,
                                     SpatialMethod::QualityGuided,
                                     SpatialMethod::ReliabilitySorted}) {
    const RelativePhase found =
        unwrap_spatially(wrapped_map(180, 140, dome, 0.05), {.method = method});
    EXPECT_EQ(found.region_count, 1);
    EXPECT_TRUE(is_true_but_for_turns(found, dome, 0.4));
  }
}

TEST(UnwrapSpatially, NumbersRegionsFromTheLargest) {
  const auto sizes = [](int x, int) { return x < 20 ? 1.0 : x < 30 ? std::nan("") : 2.0; };
  const RelativePhase found = unwrap_spatially(wrapped_map(150, 40, sizes));
  ASSERT_EQ(found.region_count, 2);
  EXPECT_EQ(found.region(5, 5), 1);
  EXPECT_EQ(found.region(100, 5), 0);
}

TEST(UnwrapSpatially, AcceptsMapsOfOnePixelAndOfOneRow) {
  const auto flat = [](int x, int) { return 0.3 * x; };
  EXPECT_EQ(unwrap_spatially(wrapped_map(1, 1, flat)).region_count, 1);
  const RelativePhase row = unwrap_spatially(wrapped_map(100, 1, flat));
  EXPECT_EQ(row.region_count, 1);
  EXPECT_TRUE(is_true_but_for_turns(row, flat, 1e-4));
  const RelativePhase column =
      unwrap_spatially(wrapped_map(1, 50, [](int, int y) { return 0.3 * y; }));
  EXPECT_EQ(column.region_count, 1);
}

TEST(UnwrapSpatially, RecordsTheGrowthOrderOnRequest) {
  WrappedPhase map = wrapped_map(60, 50, dome);
  map.modulation_counts(40, 30) = 90.0F;  // the best pixel, from which the growth starts
  EXPECT_TRUE(unwrap_spatially(map).growth_order.pixels().empty());
  for (const SpatialMethod method : {SpatialMethod::RunMerging, SpatialMethod::QualityGuided}) {
    const auto order =
        unwrap_spatially(map, {.method = method, .keep_growth_order = true}).growth_order;
    EXPECT_EQ(order(40, 30), 0);
    std::vector<std::int32_t> places(order.pixels().begin(), order.pixels().end());
    std::sort(places.begin(), places.end());
    for (std::size_t i = 0; i < places.size(); ++i)
      ASSERT_EQ(places[i], static_cast<std::int32_t>(i));
    // Each pixel except the first has a neighbour that was reached earlier.
    for (int y = 1; y < 49; ++y) {
      for (int x = 1; x < 59; ++x) {
        const int earliest =
            std::min({order(x - 1, y), order(x + 1, y), order(x, y - 1), order(x, y + 1)});
        if (order(x, y) > 0) {
          EXPECT_LT(earliest, order(x, y));
        }
      }
    }
  }
}

TEST(FindResidues, FindsTheSignOfASpiralAndIgnoresMissingPixels) {
  const auto spiral = [](double sense) {
    return wrapped_map(
        41, 41, [=](int x, int y) { return sense * std::atan2(y - 20.5, x - 20.5); });
  };
  for (const int sense : {1, -1}) {
    const auto found = find_residues(spiral(sense).phase_rad);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].x, 20);
    EXPECT_EQ(found[0].y, 20);
    EXPECT_EQ(found[0].turns, sense);  // down is clockwise from right
  }
  WrappedPhase holed = spiral(1.0);
  holed.phase_rad(21, 20) = kMissing;
  EXPECT_TRUE(find_residues(holed.phase_rad).empty());
}

TEST(DiscardResidues, DiscardsTheCoreOfASpiralAndNothingInASmoothMap) {
  WrappedPhase smooth = wrapped_map(180, 140, dome);
  EXPECT_EQ(discard_residues(smooth), 0U);
  WrappedPhase spiral =
      wrapped_map(41, 41, [](int x, int y) { return std::atan2(y - 20.5, x - 20.5); });
  EXPECT_EQ(discard_residues(spiral), 4U);
  EXPECT_EQ(spiral.status(20, 20), PixelStatus::Residue);
  EXPECT_TRUE(std::isnan(spiral.phase_rad(21, 21)));
}

}  // namespace
}  // namespace frangia
