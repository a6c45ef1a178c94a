#include "frangia/fringe_order/resolve_regions.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"
#include "frangia/range/triangulate.h"
#include "frangia/rig/paper_rig.h"

namespace frangia {
namespace {

const Pattern kPattern{.name = "fringe", .fringes_per_degree = 1.0};

/// Two walls side by side at different depths with phases of unknown fringe order.
struct TwoWalls {
  Rig rig = make_paper_rig({.columns = 100, .rows = 60});
  Image<Eigen::Vector2f> rays = rays_of(rig.reference().model);
  Image<float> truth{100, 60, kMissing};
  RelativePhase phase{.pattern = kPattern,
                      .phase_rad = Image<float>(100, 60, kMissing),
                      .sigma_rad = Image<float>(100, 60, 0.02F),
                      .region = Image<std::int32_t>(100, 60, -1),
                      .region_count = 2,
                      .status = Image<PixelStatus>(100, 60, PixelStatus::Unmodulated)};

  TwoWalls() {
    for (int y = 0; y < 60; ++y) {
      for (int x = 0; x < 100; ++x) {
        if (x >= 48 && x < 52) continue;
        const bool left = x < 50;
        const Eigen::Vector2d ray = rays(x, y).cast<double>();
        const Eigen::Vector3d point =
            (left ? 480.0 : 540.0) * Eigen::Vector3d(ray.x(), ray.y(), 1.0);
        truth(x, y) = static_cast<float>(phase_at(point, kPattern, rig.projector));
        phase.phase_rad(x, y) = static_cast<float>(truth(x, y) - kTwoPi * (left ? 3 : -5));
        phase.region(x, y) = left ? 0 : 1;
        phase.status(x, y) = PixelStatus::Measured;
      }
    }
  }
  /// A laser line at column x + 0.4.
  [[nodiscard]] std::vector<ProfilePoint> line_at(int x, double z_mm, int rows) const {
    std::vector<ProfilePoint> profile;
    for (int y = 5; y < 5 + rows; ++y) {
      const Eigen::Vector2d ray = rig.reference().model.ray({x + 0.4, static_cast<double>(y)});
      profile.push_back({.pixel = {x + 0.4, static_cast<double>(y)},
                         .point_mm = z_mm * Eigen::Vector3d(ray.x(), ray.y(), 1.0)});
    }
    return profile;
  }
};

TEST(ResolveByLaserSheet, FindsTheOrderOfTheRegionThatTheLineCrosses) {
  const TwoWalls walls;
  const ResolvedPhase resolved =
      resolve_by_laser_sheet(walls.phase, walls.line_at(20, 480.3, 30), walls.rig.projector);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 48; ++x)
      EXPECT_NEAR(resolved.phase.phase_rad(x, y), walls.truth(x, y), 1e-4);
  }
  ASSERT_EQ(resolved.unresolved.size(), 1U);
  EXPECT_EQ(resolved.unresolved[0].pixel.size(), 48U * 60U);
  EXPECT_EQ(resolved.phase.status(80, 30), PixelStatus::Unresolved);
}

TEST(ResolveByLaserSheet, LeavesARegionUnresolvedWhoseCrossingsDisagreeOrAreFew) {
  const TwoWalls walls;
  auto contradictory = walls.line_at(20, 480.0, 10);
  const auto other = walls.line_at(30, 540.0, 10);
  contradictory.insert(contradictory.end(), other.begin(), other.end());
  EXPECT_EQ(
      resolve_by_laser_sheet(walls.phase, contradictory, walls.rig.projector).unresolved.size(),
      2U);
  // Three of five agree: fewer than wanted, although the usual departure is small.
  auto mostly = walls.line_at(20, 480.0, 12);
  mostly.insert(mostly.end(), other.begin(), other.begin() + 8);
  EXPECT_EQ(resolve_by_laser_sheet(walls.phase, mostly, walls.rig.projector).unresolved.size(), 2U);
  EXPECT_EQ(resolve_by_laser_sheet(walls.phase, walls.line_at(20, 480.0, 2), walls.rig.projector)
                .unresolved.size(),
            2U);
}

TEST(ResolveByLaserSheet, BelievesFewPointsOnlyNearAnOrder) {
  // Six points of a reflection in a clipped image lay 0.19 fringes from an order, and a region was
  // 40 mm wrong.
  const TwoWalls walls;
  const Eigen::Vector3d ray = walls.line_at(20, 1.0, 1).front().point_mm;
  const double per_mm = std::abs(phase_at(481.0 * ray, kPattern, walls.rig.projector) -
                                 phase_at(480.0 * ray, kPattern, walls.rig.projector)) /
                        kTwoPi;
  const auto unresolved = [&](double departure, int points) {
    const auto line = walls.line_at(20, 480.0 + departure / per_mm, points);
    return resolve_by_laser_sheet(walls.phase, line, walls.rig.projector).unresolved.size();
  };
  EXPECT_EQ(unresolved(0.05, 6), 1U);
  EXPECT_EQ(unresolved(0.18, 6), 2U);
  EXPECT_EQ(unresolved(0.18, 30), 1U);
}

TEST(ResolveByDistance, ChoosesTheOrderClosestToTheDistance) {
  const TwoWalls walls;
  const ResolvedPhase resolved = resolve_by_distance(walls.phase, walls.rig, walls.rays, 485.0);
  EXPECT_TRUE(resolved.unresolved.empty());
  EXPECT_NEAR(resolved.phase.phase_rad(10, 10), walls.truth(10, 10), 1e-4);
}

TEST(ResolveByLaserSheet, KeepsTheSystematicPartOfThePhase) {
  TwoWalls walls;
  walls.phase.systematic_rad = Image<float>(100, 60, 0.3F);
  const ResolvedPhase resolved =
      resolve_by_laser_sheet(walls.phase, walls.line_at(20, 480.3, 30), walls.rig.projector);
  EXPECT_EQ(resolved.phase.systematic_rad(20, 30), 0.3F);
  EXPECT_TRUE(std::isnan(resolved.phase.systematic_rad(80, 30)));
  ASSERT_EQ(resolved.unresolved.size(), 1U);
  EXPECT_EQ(resolved.unresolved[0].systematic_rad,
            std::vector<float>(resolved.unresolved[0].pixel.size(), 0.3F));
}

TEST(ResolveByLaserSheet, RemovesTheBorderOfTwoRegionsAsMixed) {
  TwoWalls walls;
  for (int y = 0; y < 60; ++y) {
    for (int x = 48; x < 52; ++x) {
      walls.phase.region(x, y) = x < 50 ? 0 : 1;
      walls.phase.phase_rad(x, y) = 1.0F;
    }
  }
  const ResolvedPhase resolved =
      resolve_by_laser_sheet(walls.phase, walls.line_at(20, 480.0, 30), walls.rig.projector);
  EXPECT_EQ(resolved.phase.status(49, 30), PixelStatus::MixedPixel);
  EXPECT_EQ(resolved.phase.status(50, 30), PixelStatus::MixedPixel);
  EXPECT_EQ(resolved.phase.status(45, 30), PixelStatus::Measured);
}

}  // namespace
}  // namespace frangia
