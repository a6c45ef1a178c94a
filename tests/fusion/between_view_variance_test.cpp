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

/// A row of crossings through two blocks of the grid; voxels of 1 mm.
EdgeCrossings row_through_two_blocks() {
  EdgeCrossings crossings;
  crossings.voxel_mm = 1.0;
  for (int block = 0; block < 2; ++block) {
    auto made = std::make_unique<EdgeCrossings::Block>();
    made->crossings_before = static_cast<std::uint32_t>(block * kPerBlock);
    crossings.block_coords.emplace_back(block, 0, 0);
    crossings.index.add(block_key(block, 0, 0), static_cast<std::uint32_t>(block));
    crossings.blocks.push_back(std::move(made));
    for (int i = 0; i < kPerBlock; ++i) {
      const int voxel = block * kPerBlock + i;
      crossings.points_mm.emplace_back(static_cast<float>(voxel) + 0.5F, 4.0F, 4.0F);
    }
  }
  return crossings;
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

}  // namespace
}  // namespace frangia
