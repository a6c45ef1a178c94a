#include "frangia/service/compare_surface.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "frangia/files/write_mesh.h"

#include "support/error_of.h"
#include "support/temporary_folder.h"
#include "support/test_meshes.h"

namespace frangia {
namespace {

using testing::error_of;

/// A brick with three different sides fits itself in four poses.
class CompareSurface : public ::testing::Test {
 protected:
  CompareSurface()
      : file_(folder_.path() / "brick.ply"),
        brick_(testing::box({0.0, 0.0, 0.0}, {20.0, 12.0, 7.0})) {
    write_mesh(file_, brick_);
  }

  testing::TemporaryFolder folder_;
  std::filesystem::path file_;
  Mesh brick_;
};

TEST_F(CompareSurface, ListsThePosesThatFitAlikeAndTakesTheOneThatIsAskedFor) {
  const SurfaceComparison first = compare_surface(brick_, file_);
  ASSERT_EQ(first.poses.size(), 4U);
  EXPECT_EQ(first.turned_rad, first.poses[0].turned_rad);
  std::vector<double> turns;
  for (const ComparedPose& pose : first.poses)
    turns.push_back(pose.turned_rad);
  // The pose in which it stands, and three half turns.
  std::sort(turns.begin(), turns.end());
  EXPECT_NEAR(turns[0], 0.0, 1e-3);
  EXPECT_NEAR(turns[1], 3.14159, 1e-3);
  CompareOptions third;
  third.start = 2;
  const SurfaceComparison found = compare_surface(brick_, file_, third);
  EXPECT_EQ(found.turned_rad, first.poses[2].turned_rad);
  EXPECT_LT(std::abs(found.summary.max_mm), 0.01);
  CompareOptions beyond;
  beyond.start = 4;
  EXPECT_NE(
      error_of([&] { static_cast<void>(compare_surface(brick_, file_, beyond)); }).find("4 poses"),
      std::string::npos);
}

TEST_F(CompareSurface, AsItStandsHasNoPosesToChooseFrom) {
  CompareOptions options;
  options.best_fit = false;
  EXPECT_TRUE(compare_surface(brick_, file_, options).poses.empty());
}

}  // namespace
}  // namespace frangia
