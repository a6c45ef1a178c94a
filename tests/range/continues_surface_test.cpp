#include "frangia/range/continues_surface.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/missing.h"
#include "frangia/rig/lens.h"

namespace frangia {
namespace {

constexpr float kSigma_mm = 0.02F;

/// The left half of a cylinder of 10 mm radius, columns beyond its middle in doubt.
struct Scene {
  Lens lens{.width_px = 40,
            .height_px = 20,
            .focal_px = {1000.0, 1000.0},
            .principal_point_px = {19.5, 9.5}};
  Image<Eigen::Vector2f> rays = rays_of(lens);
  RangeGrid range{Image<float>(40, 20), Image<float>(40, 20, kSigma_mm)};
  Image<std::uint8_t> doubtful{40, 20, 0};

  Scene() {
    for (int y = 0; y < 20; ++y) {
      for (int x = 0; x < 40; ++x) {
        const float across = 0.5F * (static_cast<float>(x) - 19.5F);
        range.depth_mm(x, y) = 500.0F - std::sqrt(100.0F - across * across);
        doubtful(x, y) = x > 29 ? 1 : 0;
      }
    }
  }
  [[nodiscard]] bool continues(int x) const {
    return continues_surface({range, rays, doubtful, 7.0F}, {x, 10});
  }
};

TEST(ContinuesSurface, FollowsARoundSurface) {
  const Scene scene;
  EXPECT_TRUE(scene.continues(30));
}

TEST(ContinuesSurface, TellsAPixelOffTheSurfaceByMoreThanNoise) {
  for (const float off_mm : {-0.5F, 0.5F}) {
    Scene scene;
    scene.range.depth_mm(30, 10) += off_mm;
    EXPECT_FALSE(scene.continues(30)) << off_mm;
    scene.range.sigma_mm = Image<float>(40, 20, 0.5F);  // as much as the noise
    EXPECT_TRUE(scene.continues(30)) << off_mm;
  }
}

TEST(ContinuesSurface, TellsAPixelThatIsDarkerThanItsNeighboursLead) {
  Scene scene;
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 40; ++x)  // light that falls by 3 % a column
      scene.range.sigma_mm(x, y) = kSigma_mm / std::sqrt(1.2F - 0.03F * static_cast<float>(x));
  }
  EXPECT_TRUE(scene.continues(30));
  scene.range.sigma_mm(30, 10) /= std::sqrt(0.6F);
  EXPECT_FALSE(scene.continues(30));
}

TEST(ContinuesSurface, NeedsPixelsBesideThatAreInNoDoubt) {
  Scene scene;
  EXPECT_FALSE(scene.continues(31));  // there is one between
  for (int y = 0; y < 20; ++y)
    scene.range.depth_mm(28, y) = kMissing;  // a column alone tells no slope
  EXPECT_FALSE(scene.continues(30));
}

TEST(ContinuesSurface, IsFalseWithoutADepth) {
  Scene scene;
  scene.range.depth_mm(30, 10) = kMissing;
  EXPECT_FALSE(scene.continues(30));
}

}  // namespace
}  // namespace frangia
