#include "frangia/range/triangulate.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <variant>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/rig/paper_rig.h"
#include "frangia/rig/rig.h"

namespace frangia {
namespace {

const Pattern kAngularFringe{.name = "fringe", .fringes_per_degree = 1.0};

struct Wall {
  Rig rig = make_paper_rig({.columns = 64, .rows = 48});
  Image<Eigen::Vector2f> rays = rays_of(rig.reference().model);

  /// The phase of a plane across the view at `z_mm`.
  [[nodiscard]] AbsolutePhase phase(double z_mm, float sigma_rad) const {
    AbsolutePhase out{
        .pattern = kAngularFringe,
        .phase_rad = Image<float>(rays.width(), rays.height()),
        .sigma_rad = Image<float>(rays.width(), rays.height(), sigma_rad),
        .status = Image<PixelStatus>(rays.width(), rays.height(), PixelStatus::Measured)};
    for (std::size_t i = 0; i < rays.pixels().size(); ++i) {
      const Eigen::Vector2d ray = rays.pixels()[i].cast<double>();
      out.phase_rad.pixels()[i] = static_cast<float>(
          phase_at(z_mm * Eigen::Vector3d(ray.x(), ray.y(), 1.0), kAngularFringe, rig.projector));
    }
    return out;
  }
};

TEST(Triangulate, RecoversTheDepthOfAWall) {
  const Wall wall;
  AbsolutePhase phase = wall.phase(501.5, 0.02F);
  const RangeGrid range = triangulate(phase, wall.rig, wall.rays);
  for (const float depth : range.depth_mm.pixels())
    EXPECT_NEAR(depth, 501.5, 1e-4);
}

TEST(Triangulate, KeepsThePhaseOfEachPoint) {
  const Wall wall;
  AbsolutePhase phase = wall.phase(501.5, 0.02F);
  phase.phase_rad(3, 4) = 500.0F;  // outside of the lit field
  const RangeGrid range = triangulate(phase, wall.rig, wall.rays);
  EXPECT_TRUE(std::isnan(range.phase_rad(3, 4)));
  for (int x = 4; x < 64; ++x)
    EXPECT_EQ(range.phase_rad(x, 4), phase.phase_rad(x, 4));
}

TEST(Triangulate, PredictsTheScatterOfNoisyPhase) {
  const Wall wall;
  const float sigma = 0.02F;
  AbsolutePhase phase = wall.phase(490.0, sigma);
  std::mt19937 generator(4);
  std::normal_distribution<float> noise(0.0F, sigma);
  for (float& value : phase.phase_rad.pixels())
    value += noise(generator);
  const RangeGrid range = triangulate(phase, wall.rig, wall.rays);
  double chi_square = 0.0;
  for (std::size_t i = 0; i < range.depth_mm.pixels().size(); ++i) {
    const double along_ray = std::sqrt(1.0 + wall.rays.pixels()[i].squaredNorm());
    const double error = (range.depth_mm.pixels()[i] - 490.0) * along_ray;
    chi_square += std::pow(error / range.sigma_mm.pixels()[i], 2);
  }
  EXPECT_NEAR(chi_square / static_cast<double>(range.depth_mm.pixels().size()), 1.0, 0.08);
}

TEST(Triangulate, PropagatesTheSystematicPartAsTheNoise) {
  const Wall wall;
  AbsolutePhase phase = wall.phase(490.0, 0.02F);
  EXPECT_TRUE(triangulate(phase, wall.rig, wall.rays).systematic_mm.empty());
  phase.systematic_rad = Image<float>(wall.rays.width(), wall.rays.height(), 0.05F);
  phase.phase_rad(5, 4) = phase.systematic_rad(5, 4) = kMissing;
  const RangeGrid range = triangulate(phase, wall.rig, wall.rays);
  EXPECT_TRUE(std::isnan(range.systematic_mm(5, 4)));
  for (int x = 6; x < 64; ++x)
    EXPECT_NEAR(range.systematic_mm(x, 4), 2.5F * range.sigma_mm(x, 4), 1e-6F);
}

TEST(Triangulate, LeavesOutPhasesThatTheProjectorDoesNotShow) {
  const Wall wall;
  AbsolutePhase phase = wall.phase(490.0, 0.02F);
  phase.phase_rad(3, 4) = 500.0F;  // 80 fringes from the axis of a field of 24
  phase.phase_rad(5, 4) = kMissing;
  const RangeGrid range = triangulate(phase, wall.rig, wall.rays);
  EXPECT_TRUE(std::isnan(range.depth_mm(3, 4)));
  EXPECT_EQ(phase.status(3, 4), PixelStatus::OutOfField);
  EXPECT_TRUE(std::isnan(range.depth_mm(5, 4)));
}

TEST(Triangulate, ReachesFourSigmaBeyondTheField) {
  Wall wall;
  constexpr float kOfPhase_rad = 0.1F;
  AbsolutePhase phase = wall.phase(490.0, kOfPhase_rad);
  const Image<float> truth = phase.phase_rad;
  const auto [low, high] = std::minmax_element(truth.pixels().begin(), truth.pixels().end());
  ASSERT_GT(*high - *low, 10.0F);
  auto& field = std::get<AngularModel>(wall.rig.projector.model);
  const double fringe_rad =
      phase_range(phase.pattern, wall.rig.projector).max_rad / field.field_max_rad;
  field.field_min_rad = (static_cast<double>(*low) + 2.0) / fringe_rad;
  field.field_max_rad = (static_cast<double>(*high) - 2.0) / fringe_rad;
  const RangeGrid range = triangulate(phase, wall.rig, wall.rays);
  int below = 0;
  int above = 0;
  for (std::size_t i = 0; i < truth.pixels().size(); ++i) {
    const float beyond_rad =
        std::max(*low + 2.0F - truth.pixels()[i], truth.pixels()[i] - (*high - 2.0F));
    EXPECT_EQ(std::isnan(range.depth_mm.pixels()[i]), beyond_rad > 4.0F * kOfPhase_rad)
        << beyond_rad;
    if (beyond_rad > 0.0F && beyond_rad < 4.0F * kOfPhase_rad)
      ++(truth.pixels()[i] < 0.5F * (*low + *high) ? below : above);
  }
  EXPECT_GT(below, 0);
  EXPECT_GT(above, 0);
}

TEST(Triangulate, StatesSigmaAlongTheRay) {
  const Wall wall;
  constexpr double kDepth_mm = 490.0;
  const Eigen::Vector2d oblique(0.4, -0.7);  // 39 degrees from the axis of the camera
  const Image<Eigen::Vector2f> rays(1, 1, oblique.cast<float>());
  const auto phase_of = [&](double depth_mm) {
    return phase_at(depth_mm * oblique.homogeneous(), kAngularFringe, wall.rig.projector);
  };
  Rig rig = wall.rig;
  std::get<AngularModel>(rig.projector.model).field_min_rad = -1.5;
  std::get<AngularModel>(rig.projector.model).field_max_rad = 1.5;
  AbsolutePhase phase{.pattern = kAngularFringe,
                      .phase_rad = Image<float>(1, 1, static_cast<float>(phase_of(kDepth_mm))),
                      .sigma_rad = Image<float>(1, 1, 0.03F),
                      .status = Image<PixelStatus>(1, 1, PixelStatus::Measured)};
  const RangeGrid range = triangulate(phase, rig, rays);
  constexpr double kStep_mm = 0.1;
  const double rad_per_mm =
      std::abs(phase_of(kDepth_mm + kStep_mm) - phase_of(kDepth_mm - kStep_mm)) /
      (2.0 * kStep_mm * oblique.homogeneous().norm());
  EXPECT_NEAR(range.sigma_mm(0, 0), 0.03 / rad_per_mm, 1e-4 * 0.03 / rad_per_mm);
}

TEST(Triangulate, RefusesAPhaseOfAnotherSize) {
  const Wall wall;
  AbsolutePhase phase = wall.phase(490.0, 0.02F);
  EXPECT_THROW(static_cast<void>(triangulate(
                   phase, wall.rig, Image<Eigen::Vector2f>(3, 3, Eigen::Vector2f::Zero()))),
               Error);
}

}  // namespace
}  // namespace frangia
