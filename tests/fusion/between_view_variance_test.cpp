#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/fusion/internal/hermite_accumulators.h"

namespace frangia {
namespace {

constexpr int kPerBlock = 8;  // crossings, one a voxel

/// A row of crossings through two blocks of the grid along an axis.
EdgeCrossings row_through_two_blocks(int axis = 0, double voxel_mm = 1.0) {
  EdgeCrossings crossings;
  crossings.voxel_mm = voxel_mm;
  for (int block = 0; block < 2; ++block) {
    auto made = std::make_unique<EdgeCrossings::Block>();
    made->crossings_before = static_cast<std::uint32_t>(block * kPerBlock);
    const Eigen::Vector3i coords = block * Eigen::Vector3i::Unit(axis);
    crossings.block_coords.push_back(coords);
    crossings.index.add(block_key(coords), static_cast<std::uint32_t>(block));
    crossings.blocks.push_back(std::move(made));
    for (int i = 0; i < kPerBlock; ++i) {
      Eigen::Vector3f at(4.0F, 4.0F, 4.0F);
      at(axis) = static_cast<float>(block * kPerBlock + i) + 0.5F;
      crossings.points_mm.push_back(static_cast<float>(voxel_mm) * at);
    }
  }
  return crossings;
}

/// A view's distance from a crossing, with its weight and the variances that it states.
struct Observed {
  float weight;
  float distance_mm;
  float noise_mm2;
  float lateral_mm2 = 0.0F;
};

void add_views(HermiteAccumulator::PlaneSum& face, const std::vector<Observed>& views) {
  for (const Observed& view : views) {
    face.weight += view.weight;
    face.weight_squared += view.weight * view.weight;
    face.offset += view.weight * view.distance_mm;
    face.offset_squared += view.weight * view.distance_mm * view.distance_mm;
    face.noise += view.weight * view.noise_mm2;
    face.noise_squared += view.weight * view.weight * view.noise_mm2;
    face.lateral_squared += view.weight * view.weight * view.lateral_mm2;
    ++face.views;
  }
}

TEST(BetweenViewVariance, ChangesWithoutAStepFromABlockToTheNext) {
  const EdgeCrossings crossings = row_through_two_blocks();
  HermiteAccumulators hermite(crossings.points_mm.size());
  // Two views of equal weight without noise, which agree in one block and are 1 mm to either side
  // in the other: a variance of 2 mm² of one of them, of 1 mm² of their mean.
  for (std::size_t i = 0; i < hermite.size(); ++i) {
    HermiteAccumulator::PlaneSum& face = hermite[i].first;
    face.weight = 2.0F;
    face.weight_squared = 2.0F;
    face.offset_squared = i < kPerBlock ? 0.0F : 2.0F;
    face.views = 2;
  }
  add_between_view_variance(hermite, crossings);
  EXPECT_EQ(hermite[0].common_variance, 0.0F);
  EXPECT_EQ(hermite[hermite.size() - 1].common_variance, 1.0F);
  float largest = 0.0F;
  for (std::size_t i = 1; i < hermite.size(); ++i) {
    const float step = hermite[i].common_variance - hermite[i - 1].common_variance;
    EXPECT_GE(step, 0.0F);
    largest = std::max(largest, step);
  }
  EXPECT_LT(largest, 0.15F);
}

TEST(BetweenViewVariance, IsHalfTheSquaredDifferenceOfTwoViewsBeyondTheirNoise) {
  const EdgeCrossings crossings = row_through_two_blocks();
  HermiteAccumulators hermite(crossings.points_mm.size());
  for (std::size_t i = 0; i < hermite.size(); ++i)
    add_views(hermite[i].first, {{1.0F, 0.1F, 0.02F}, {3.0F, 0.7F, 0.05F}});
  add_between_view_variance(hermite, crossings);
  // DerSimonian and Laird's estimate for two: whatever the weights are.
  const float between = (0.6F * 0.6F - 0.02F - 0.05F) / 2.0F;
  for (std::size_t i = 0; i < hermite.size(); ++i)
    EXPECT_NEAR(hermite[i].common_variance, between * (1.0F + 9.0F) / 16.0F, 1e-6F);
}

TEST(BetweenViewVariance, IsNotBelowThatOfLateralError) {
  const EdgeCrossings crossings = row_through_two_blocks();
  HermiteAccumulators hermite(crossings.points_mm.size());
  for (std::size_t i = 0; i < hermite.size(); ++i)
    add_views(hermite[i].first, {{1.0F, 0.1F, 0.02F, 0.3F}, {3.0F, 0.11F, 0.05F, 0.2F}});
  add_between_view_variance(hermite, crossings);
  EXPECT_NEAR(hermite[0].common_variance, (0.3F + 9.0F * 0.2F) / 16.0F, 1e-6F);
}

TEST(BetweenViewVariance, OfASingleViewIsThatOfThePlacesAround) {
  const EdgeCrossings crossings = row_through_two_blocks();
  HermiteAccumulators hermite(crossings.points_mm.size());
  for (std::size_t i = 0; i < hermite.size(); ++i) {
    if (i % 3 == 0)
      add_views(hermite[i].first, {{2.0F, 9.0F, 0.0F}});
    else if (i % 3 == 1)
      add_views(hermite[i].first, {{1.0F, 0.0F, 0.01F}, {1.0F, 0.4F, 0.01F}});
  }
  add_between_view_variance(hermite, crossings);
  EXPECT_NEAR(hermite[0].common_variance, 0.07F, 1e-6F);
  EXPECT_NEAR(hermite[1].common_variance, 0.5F * 0.07F, 1e-6F);
  EXPECT_EQ(hermite[2].common_variance, 0.0F) << "no view observed it";
}

TEST(BetweenViewVariance, InterpolatesBetweenTheCentersOfBlocksAlongEachAxis) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double voxel_mm : {1.0, 0.25}) {
      const EdgeCrossings crossings = row_through_two_blocks(axis, voxel_mm);
      HermiteAccumulators hermite(crossings.points_mm.size());
      for (std::size_t i = 0; i < hermite.size(); ++i) {
        const float apart = i < kPerBlock ? 0.2F : 0.6F;
        add_views(hermite[i].first, {{1.0F, 0.0F, 0.0F}, {1.0F, apart, 0.0F}});
      }
      add_between_view_variance(hermite, crossings);
      for (std::size_t i = 0; i < hermite.size(); ++i) {
        // Centres at 4 and 12 voxels; beyond them the nearest block alone.
        const float share = std::clamp((static_cast<float>(i) + 0.5F - 4.0F) / 8.0F, 0.0F, 1.0F);
        const float between = 0.5F * ((1.0F - share) * 0.04F + share * 0.36F);
        EXPECT_NEAR(hermite[i].common_variance, 0.5F * between, 1e-6F) << axis << " " << i;
      }
    }
  }
}

/// A face in the middle of three blocks in a row, of which two rows at its lower end lie on the
/// edge of a step that the views see differently.
TEST(BetweenViewVariance, OfTheEdgeOfAStepStaysBesideIt) {
  EdgeCrossings crossings;
  crossings.voxel_mm = 1.0;
  for (int block = 0; block < 3; ++block) {
    auto made = std::make_unique<EdgeCrossings::Block>();
    made->crossings_before = static_cast<std::uint32_t>(64 * block);
    crossings.block_coords.emplace_back(block, 0, 0);
    crossings.index.add(block_key(crossings.block_coords.back()),
                        static_cast<std::uint32_t>(block));
    crossings.blocks.push_back(std::move(made));
    for (int x = 0; x < 8; ++x) {
      for (int y = 0; y < 8; ++y)
        crossings.points_mm.emplace_back(
            static_cast<float>(8 * block + x) + 0.5F, static_cast<float>(y) + 0.5F, 4.0F);
    }
  }
  HermiteAccumulators hermite(crossings.points_mm.size());
  for (std::size_t i = 0; i < hermite.size(); ++i) {
    const bool at_edge = i >= 64 && i < 80;  // 8 to 10 mm
    add_views(hermite[i].first, {{1.0F, 0.0F, 0.0F}, {1.0F, at_edge ? 0.5F : 0.01F, 0.0F}});
  }
  add_between_view_variance(hermite, crossings);
  const float usual = 0.5F * 0.5F * 0.01F * 0.01F;
  for (std::size_t i = 0; i < hermite.size(); ++i) {
    const float x = crossings.points_mm[i].x();
    if (x > 6.0F && x < 12.0F)
      EXPECT_GT(hermite[i].common_variance, 100.0F * usual) << x;
    else
      EXPECT_NEAR(hermite[i].common_variance, usual, 0.01F * usual) << x;
  }
}

TEST(BetweenViewVariance, ScalesTheStatedVarianceThatDiffersByViewToWhatIsFound) {
  const EdgeCrossings crossings = row_through_two_blocks();
  for (const float stated : {0.5F, 0.1F}) {
    HermiteAccumulators hermite(crossings.points_mm.size(), true);
    for (std::size_t i = 0; i < hermite.size(); ++i) {
      add_views(hermite[i].first, {{1.0F, 0.1F, 0.02F}, {3.0F, 0.8F, 0.07F}});
      hermite.systematic_sums(i).first.differing_squared = (1.0F + 9.0F) * stated;
    }
    add_between_view_variance(hermite, crossings);
    const float between = (0.7F * 0.7F - 0.02F - 0.07F) / 2.0F;  // 0.2
    EXPECT_NEAR(hermite[0].common_variance, between * 10.0F / 16.0F, 1e-6F);
    hermite[0].common_variance = 0.0F;
    EXPECT_NEAR(
        hermite.systematic_mm(0), std::sqrt(std::min(between, stated) * 10.0F / 16.0F), 1e-5F);
  }
}

}  // namespace
}  // namespace frangia
