#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/missing.h"
#include "frangia/range/internal/pixel_connections.h"
#include "frangia/rig/camera_model.h"

namespace frangia {
namespace {

constexpr float kSigma_mm = 0.02F;

/// A cylinder of 10 mm radius; the pixels of columns from 30 on are not reliable.
struct HalfCylinder {
  CameraModel model{.width_px = 40,
                    .height_px = 20,
                    .focal_px = {1000.0, 1000.0},
                    .principal_point_px = {19.5, 9.5}};
  Image<Eigen::Vector2f> rays = rays_of(model);
  RangeGrid all{Image<float>(40, 20), Image<float>(40, 20, kSigma_mm)};

  HalfCylinder() {
    for (int y = 0; y < 20; ++y) {
      for (int x = 0; x < 40; ++x) {
        const float across = 0.5F * (static_cast<float>(x) - 19.5F);
        all.depth_mm(x, y) = 500.0F - std::sqrt(100.0F - across * across);
      }
    }
  }
  [[nodiscard]] bool continues(int x) const {
    RangeGrid reliable = all;
    for (int y = 0; y < 20; ++y) {
      for (int u = 30; u < 40; ++u)
        reliable.depth_mm(u, y) = kMissing;
    }
    return continues_surface({reliable, rays, 7.0F},
                             {x, 10, all.depth_mm(x, 10), all.sigma_mm(x, 10)});
  }
};

TEST(ContinuesSurface, FollowsARoundSurface) {
  const HalfCylinder scene;
  EXPECT_TRUE(scene.continues(30));
}

TEST(ContinuesSurface, RejectsAPixelOffTheSurfaceByMoreThanNoise) {
  for (const float off_mm : {-0.5F, 0.5F}) {
    HalfCylinder scene;
    scene.all.depth_mm(30, 10) += off_mm;
    EXPECT_FALSE(scene.continues(30)) << off_mm;
    scene.all.sigma_mm = Image<float>(40, 20, 0.5F);  // as much as the noise
    EXPECT_TRUE(scene.continues(30)) << off_mm;
  }
}

TEST(ContinuesSurface, RejectsAPixelDarkerThanExpected) {
  HalfCylinder scene;
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 40; ++x)  // light that falls by 3 % a column
      scene.all.sigma_mm(x, y) = kSigma_mm / std::sqrt(1.2F - 0.03F * static_cast<float>(x));
  }
  EXPECT_TRUE(scene.continues(30));
  scene.all.sigma_mm(30, 10) /= std::sqrt(0.6F);
  EXPECT_FALSE(scene.continues(30));
}

TEST(ContinuesSurface, NeedsReliableNeighbors) {
  HalfCylinder scene;
  EXPECT_FALSE(scene.continues(31));  // pixel 30 lies between
  for (int y = 0; y < 20; ++y)
    scene.all.depth_mm(28, y) = kMissing;  // a single column does not determine a slope
  EXPECT_FALSE(scene.continues(30));
}

}  // namespace
}  // namespace frangia
