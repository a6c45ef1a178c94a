#include "frangia/registration/internal/view_pairs.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "frangia/local_fit/surfel_map.h"

#include "support/analytic_views.h"

namespace frangia {
namespace {

ViewPairs pairs_around_table(int count) {
  const CameraModel camera = testing::small_camera_model(160, 800.0);
  const auto poses = testing::around_table(count, 0.4, 650.0);
  const ViewStore views = testing::snapshots(testing::lumpy, camera, poses);
  return choose_view_pairs(make_surfel_maps(views, camera), FastCameraModel(camera), poses);
}

bool has(const std::vector<std::size_t>& views, std::size_t view) {
  return std::binary_search(views.begin(), views.end(), view);
}

TEST(ViewPairs, AreAllPairsOfFewViews) {
  EXPECT_EQ(pairs_around_table(24), all_view_pairs(24));
  EXPECT_EQ(count_pairs(all_view_pairs(24)), 24U * 23U);
}

TEST(ViewPairs, OfManyViewsAreNeighboursAndOverlappingViews) {
  constexpr std::size_t kViews = 60;
  const ViewPairs pairs = pairs_around_table(kViews);
  for (std::size_t view = 0; view < kViews; ++view) {
    EXPECT_TRUE(has(pairs[view], (view + 1) % kViews)) << view;
    EXPECT_TRUE(has(pairs[view], (view + kViews - 1) % kViews)) << view;
    // Views on both sides at a right angle or more constrain the axis best.
    const auto far = std::count_if(pairs[view].begin(), pairs[view].end(), [&](std::size_t other) {
      const std::size_t apart = (other + kViews - view) % kViews;
      return std::min(apart, kViews - apart) >= kViews / 6;
    });
    EXPECT_GE(far, 3) << view;
    for (const std::size_t other : pairs[view])
      EXPECT_TRUE(has(pairs[other], view)) << view << ' ' << other;
  }
  EXPECT_LE(count_pairs(pairs), kViews * 24);
}

TEST(ViewPairs, TakeNoMoreComparisonsForManyViewsThanFor24) {
  constexpr std::size_t kViews = 96;
  const std::size_t comparisons =
      count_pairs(pairs_around_table(kViews)) * surfels_per_view(20000, kViews);
  EXPECT_LE(comparisons, count_pairs(all_view_pairs(24)) * surfels_per_view(20000, 24));
}

TEST(ViewPairs, OmitViewsThatShowAnotherSide) {
  const CameraModel camera = testing::small_camera_model(160, 800.0);
  // 30 views from two opposite sides, 0.01 rad apart.
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < 30; ++i)
    poses.push_back(testing::look_from(0.01 * i + (i < 15 ? 0.0 : kPi), 0.0, 650.0));
  const ViewStore views = testing::snapshots(testing::box({20.0, 20.0, 20.0}), camera, poses);
  const ViewPairs pairs =
      choose_view_pairs(make_surfel_maps(views, camera), FastCameraModel(camera), poses);
  for (std::size_t view = 0; view < 15; ++view) {
    ASSERT_FALSE(pairs[view].empty()) << view;
    EXPECT_LT(pairs[view].back(), 15U) << view;
  }
}

}  // namespace
}  // namespace frangia
