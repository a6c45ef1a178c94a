#include "frangia/indirect_light/indirect_correction.h"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "frangia/core/missing.h"
#include "frangia/range/triangulate.h"

#include "support/two_walls.h"

namespace frangia {
namespace {

constexpr double kCorrectionFar_mm = testing::kWallsFar_mm;
constexpr double kProjector_mm = -100.0;
constexpr int kWidth = 101;
constexpr int kHeight = 9;

/// Rays 0.5 mm apart at the surface.
Image<Eigen::Vector2f> camera_rays() {
  Image<Eigen::Vector2f> rays(kWidth, kHeight, Eigen::Vector2f::Zero());
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x)
      rays(x, y) = Eigen::Vector2f(static_cast<float>(x - 50), static_cast<float>(y - 4)) * 1e-4F;
  }
  return rays;
}

std::vector<Pattern> coarse_fringes() {
  std::vector<Pattern> out{{.name = "p", .period_px = 64.0}};
  out.back().shifts_rad = {0.0, 1.0, 2.0};
  return out;
}

/// The walls without the points of the columns `first` to `last`, whose last one is recovered.
View view_with_gap(const Image<Eigen::Vector2f>& rays, double sign, int first, int last) {
  View view;
  const Image<float> none(kWidth, kHeight, kMissing);
  view.range = {none, none, none, {}};
  const auto pattern = coarse_fringes().back();
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double slope = std::abs(static_cast<double>(rays(x, y).x()));
      const double depth = kCorrectionFar_mm / (1.0 + sign * slope);
      const double phase = phase_at(depth * rays(x, y).cast<double>().homogeneous(),
                                    pattern,
                                    testing::far_projector(kProjector_mm));
      const RangePixel at{
          x, y, static_cast<float>(depth), 0.01F, static_cast<float>(phase), kMissing};
      if (x == last) view.edge_pixels.push_back(at);
      if (x >= first && x <= last) continue;
      view.range.depth_mm(x, y) = at.depth_mm;
      view.range.sigma_mm(x, y) = at.sigma_mm;
      view.range.phase_rad(x, y) = at.phase_rad;
    }
  }
  return view;
}

View corrected(double sign, int first, int last) {
  const auto rays = camera_rays();
  const auto surface = std::make_shared<const LitSurface>(
      testing::two_walls(40.0, 40, sign), testing::far_projector(kProjector_mm), coarse_fringes());
  View view = view_with_gap(rays, sign, first, last);
  const std::vector<Eigen::Isometry3d> no_poses;  // each pixel is traced
  const auto collected = std::make_shared<const SurfaceLight>(surface, no_poses);
  IndirectCorrection(collected, 0.8, PhaseSource::Finest, true).correct(view, rays);
  return view;
}

TEST(IndirectCorrection, RemovesTheRimOfAGapThatIndirectLightMayHaveMade) {
  const View view = corrected(1.0, 46, 54);
  constexpr int kMiddle = kHeight / 2;
  EXPECT_TRUE(view.edge_pixels.empty());
  EXPECT_TRUE(std::isnan(view.range.depth_mm(45, kMiddle)));
  EXPECT_TRUE(std::isnan(view.range.depth_mm(55, kMiddle)));
  EXPECT_FALSE(std::isnan(view.range.depth_mm(44, kMiddle)));
  EXPECT_FALSE(std::isnan(view.range.depth_mm(56, kMiddle)));
}

TEST(IndirectCorrection, KeepsTheRimOfAGapWithoutIndirectLight) {
  const View view = corrected(-1.0, 46, 54);
  EXPECT_EQ(view.edge_pixels.size(), static_cast<std::size_t>(kHeight));
  EXPECT_FALSE(std::isnan(view.range.depth_mm(45, kHeight / 2)));
}

}  // namespace
}  // namespace frangia
