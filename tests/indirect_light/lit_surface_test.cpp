#include "frangia/indirect_light/lit_surface.h"

#include <cmath>
#include <complex>

#include <gtest/gtest.h>

#include "frangia/core/missing.h"
#include "frangia/core/random.h"
#include "frangia/indirect_light/estimate_albedo.h"
#include "frangia/indirect_light/indirect_phase.h"
#include "frangia/indirect_light/view_light.h"
#include "frangia/range/triangulate.h"

#include "support/two_walls.h"

namespace frangia {
namespace {

using testing::far_projector;

constexpr double kFar_mm = testing::kWallsFar_mm;
constexpr double kWall_mm = 40.0;

Mesh right_angle(int across = 40) {
  return testing::two_walls(kWall_mm / std::sqrt(2.0), across);
}

std::vector<Pattern> patterns_with(std::initializer_list<double> periods_px) {
  std::vector<Pattern> out;
  for (const double period : periods_px) {
    out.push_back({.name = "p", .period_px = period});
    out.back().shifts_rad = {0.0, 1.0, 2.0};
  }
  return out;
}

/// Camera rays of one row of 101 pixels, 0.5 mm apart at the surface.
Image<Eigen::Vector2f> row_of_rays() {
  Image<Eigen::Vector2f> rays(101, 3, Eigen::Vector2f::Zero());
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 101; ++x)
      rays(x, y) = Eigen::Vector2f(static_cast<float>(x - 50), static_cast<float>(y - 1)) * 1e-4F;
  }
  return rays;
}

View view_of_right_angle(const Image<Eigen::Vector2f>& rays) {
  View view;
  view.range = {Image<float>(101, 3, kMissing), Image<float>(101, 3, 0.01F)};
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 101; ++x) {
      const double slope = std::abs(static_cast<double>(rays(x, y).x()));
      view.range.depth_mm(x, y) = static_cast<float>(kFar_mm / (1.0 + slope));
    }
  }
  return view;
}

TEST(LitSurface, ShadesLargeTrianglesAtACreaseAsTheirFaces) {
  const auto patterns = patterns_with({16.0});
  const LitSurface fine(right_angle(), far_projector(), patterns);
  const LitSurface coarse(right_angle(1), far_projector(), patterns);
  // 0.3 mm is near the crease: rays must not start farther away from the surface than that.
  for (const double x_mm : {0.3, 1.0, 5.0, 12.0, 22.0}) {
    const Eigen::Vector3d ray(x_mm / (kFar_mm - x_mm), 0.0, 1.0);
    const auto light = [&](const LitSurface& surface) {
      double distance = 0.0;
      return surface.light_along(
          Eigen::Isometry3d::Identity(), Eigen::Vector3d::Zero(), ray, distance);
    };
    const double s = x_mm * std::sqrt(2.0);
    const double factor = 0.5 * (1.0 - s / std::hypot(s, kWall_mm));
    const PointLight found = light(coarse);
    EXPECT_NEAR(found.indirect / found.direct, factor, 0.015) << x_mm;
    EXPECT_NEAR(found.direct / light(fine).direct, 1.0, 0.005) << x_mm;
  }
}

TEST(LitSurface, PredictsTheFormFactorAndTheFringesOfARightAngle) {
  const auto patterns = patterns_with({200.0, 16.0});
  const LitSurface surface(right_angle(), far_projector(), patterns);
  for (const double x_mm : {5.0, 12.0, 22.0}) {
    double distance = 0.0;
    const Eigen::Vector3d ray(x_mm / (kFar_mm - x_mm), 0.0, 1.0);
    const PointLight light =
        surface.light_along(Eigen::Isometry3d::Identity(), Eigen::Vector3d::Zero(), ray, distance);
    EXPECT_NEAR(distance, kFar_mm - x_mm, 0.1);
    const double s = x_mm * std::sqrt(2.0);
    const double factor = 0.5 * (1.0 - s / std::hypot(s, kWall_mm));
    EXPECT_NEAR(light.indirect / light.direct, factor, 0.08 * factor) << x_mm;
    for (std::size_t m = 0; m < patterns.size(); ++m) {
      std::complex<double> expected = 0.0;
      constexpr int kStrips = 20000;
      for (int i = 0; i < kStrips; ++i) {
        const double t = kWall_mm * (i + 0.5) / kStrips;
        const Eigen::Vector3d at(-t / std::sqrt(2.0), 0.0, kFar_mm - t / std::sqrt(2.0));
        expected += 0.5 * s * t / std::pow(s * s + t * t, 1.5) * kWall_mm / kStrips *
                    std::polar(1.0, phase_at(at, patterns[m], surface.projector()));
      }
      EXPECT_LT(std::abs(light.fringes[m] / light.direct - expected), 0.15 * factor)
          << x_mm << " " << m;
    }
  }
}

TEST(LitSurface, SeesNoIndirectLightOnAConvexSurface) {
  Mesh ridge = right_angle();
  for (auto& vertex : ridge.vertices_mm)
    vertex.z() = static_cast<float>(kFar_mm) - 50.0F + std::abs(vertex.x());
  const LitSurface surface(ridge, far_projector(), patterns_with({16.0}));
  double distance = 0.0;
  const PointLight light = surface.light_along(
      Eigen::Isometry3d::Identity(), Eigen::Vector3d::Zero(), {10.0 / kFar_mm, 0.0, 1.0}, distance);
  EXPECT_GT(light.direct, 0.0);
  EXPECT_EQ(light.indirect, 0.0);
}

TEST(ViewLight, InterpolatesBetweenItsNodes) {
  const LitSurface surface(right_angle(), far_projector(), patterns_with({200.0, 16.0}));
  const auto rays = row_of_rays();
  const View view = view_of_right_angle(rays);
  const ViewLight every(surface, view, rays, LightUse::FewPixels);
  const ViewLight coarse(surface, view, rays, LightUse::Correction);
  for (int x = 4; x < 97; ++x) {
    const auto depth = static_cast<double>(view.range.depth_mm(x, 1));
    const IndirectShare exact = every.at(x, 1, depth);
    const IndirectShare found = coarse.at(x, 1, depth);
    if (std::abs(x - 50) < 6) continue;  // at the corner it changes within a node
    EXPECT_NEAR(found.mean, exact.mean, 0.03) << x;
    EXPECT_LT(std::abs(found.fringes[0] - exact.fringes[0]), 0.03) << x;
  }
}

TEST(ViewLight, NearAGapOfTheSurfaceTakesTheLightOfTheLitPixelsAround) {
  Mesh gap = right_angle();
  std::erase_if(gap.triangles, [&](const auto& triangle) {
    const float x = gap.vertices_mm[triangle[0]].x();
    return x > 8.0F && x < 9.5F;
  });
  const LitSurface surface(gap, far_projector(), patterns_with({200.0, 16.0}));
  const auto rays = row_of_rays();
  const View view = view_of_right_angle(rays);
  const ViewLight light(surface, view, rays, LightUse::FewPixels);
  const auto at = [&](int x, bool near) {
    const auto depth = static_cast<double>(view.range.depth_mm(x, 1));
    return near ? light.near(x, 1, depth) : light.at(x, 1, depth);
  };
  const int hole = 68;  // 9 mm
  ASSERT_EQ(at(hole, false).mean, 0.0);
  EXPECT_NEAR(at(hole, true).mean, at(hole - 3, false).mean, 0.05);
  EXPECT_GT(at(hole, true).mean, 0.2);
  EXPECT_EQ(at(hole - 8, true).mean, at(hole - 8, false).mean);
}

TEST(IndirectPhase, IsThatOfTheFinestPatternOrOfTheSlope) {
  const auto patterns = patterns_with({128.0, 16.0});
  IndirectShare share;
  share.mean = 0.3;
  share.fringes = {std::polar(0.2, 1.2), std::polar(0.05, 0.4)};
  const double coarse = std::arg(1.0 + 0.8 * share.fringes[0]);
  const double fine = std::arg(1.0 + 0.8 * share.fringes[1]);
  const IndirectPhase finest = indirect_phase(share, 0.8, patterns, PhaseSource::Finest);
  EXPECT_DOUBLE_EQ(finest.error_rad, fine);
  EXPECT_FALSE(finest.wrong_order);
  const IndirectPhase slope = indirect_phase(share, 0.8, patterns, PhaseSource::Slope);
  EXPECT_NEAR(slope.error_rad, (fine + 0.125 * coarse) / (1.0 + 0.125 * 0.125), 1e-12);
  EXPECT_EQ(indirect_phase(share, 0.0, patterns, PhaseSource::Slope).sigma_rad, 0.0);
  // Eight times an error of 0.45 rad is more than half a fringe.
  share.fringes[0] = std::polar(0.6, 1.6);
  EXPECT_TRUE(indirect_phase(share, 0.8, patterns, PhaseSource::Finest).wrong_order);
}

/// Samples of a right angle with this reflectance, contrast 0.9, ambient light and noise.
std::vector<AlbedoSample> samples_of(std::span<const Pattern> patterns, double albedo) {
  const LitSurface surface(
      right_angle(), far_projector(), std::vector<Pattern>(patterns.begin(), patterns.end()));
  const auto rays = row_of_rays();
  const View view = view_of_right_angle(rays);
  const ViewLight light(surface, view, rays, LightUse::FewPixels);
  std::vector<AlbedoSample> out;
  for (std::uint64_t i = 0; i < 303; ++i) {
    const int x = static_cast<int>(i % 101);
    const int y = static_cast<int>(i / 101);
    AlbedoSample sample;
    sample.predicted = light.at(x, y, static_cast<double>(view.range.depth_mm(x, y)));
    if (sample.predicted.mean > 1.0) continue;
    const double sigma = 0.01;
    const double direct = 50.0 * (0.4 + 0.6 * uniform_from(hash(30, i)));  // counts
    std::vector<double> errors;
    for (const auto& fringe : sample.predicted.fringes)
      errors.push_back(std::arg(1.0 + albedo * fringe));
    for (std::size_t m = 0; m < patterns.size(); ++m) {
      const double modulation = std::abs(1.0 + albedo * sample.predicted.fringes[m]) * direct *
                                (1.0 + sigma * normal_from(hash(10 + m, i)));
      const double mean = direct / 0.9 * (1.0 + albedo * sample.predicted.mean) + 4.0;
      const double ratio = patterns[m].fringes_per_unit() / patterns.back().fringes_per_unit();
      const double residual = m + 1 == patterns.size() ? 0.0
                                                       : errors[m] - ratio * errors.back() +
                                                             sigma * normal_from(hash(20 + m, i));
      sample.measured.push_back({static_cast<float>(mean / modulation),
                                 static_cast<float>(1.0 / modulation),
                                 static_cast<float>(sigma),
                                 static_cast<float>(residual)});
    }
    out.push_back(sample);
  }
  return out;
}

TEST(EstimateAlbedo, FindsTheReflectanceOfOneAndOfSeveralPatterns) {
  for (const auto& patterns : {patterns_with({16.0}), patterns_with({400.0, 60.0, 16.0})}) {
    for (const double albedo : {0.3, 0.8}) {
      const AlbedoEstimate found = estimate_albedo(samples_of(patterns, albedo), patterns);
      EXPECT_TRUE(found.significant);
      EXPECT_NEAR(found.albedo, albedo, 0.08) << patterns.size();
    }
  }
}

TEST(EstimateAlbedo, FindsNothingWithoutIndirectLight) {
  for (const auto& patterns : {patterns_with({16.0}), patterns_with({400.0, 60.0, 16.0})}) {
    const AlbedoEstimate found = estimate_albedo(samples_of(patterns, 0.0), patterns);
    EXPECT_FALSE(found.significant) << found.improvement;
    EXPECT_EQ(found.albedo, 0.0);
  }
  EXPECT_FALSE(estimate_albedo({}, patterns_with({16.0})).significant);
}

TEST(DirectPhase, IsSolvedWhereverThePointWasAssumed) {
  const auto patterns = patterns_with({160.0, 20.0});
  constexpr double kAlbedo = 0.8;
  constexpr double kTrue_rad = 40.0;
  for (const double indirect_rad : {38.0, 40.5, 43.0}) {
    const auto share_at = [&](double phase_rad) {
      IndirectShare share;
      share.mean = 0.9;
      for (const double ratio : {0.125, 1.0})
        share.fringes.push_back(std::polar(0.8, ratio * (indirect_rad - phase_rad)));
      return share;
    };
    const double measured =
        kTrue_rad +
        indirect_phase(share_at(kTrue_rad), kAlbedo, patterns, PhaseSource::Finest).error_rad;
    for (const double assumed : {39.2, 40.0, 41.0}) {
      const SolvedPhase found = direct_phase(
          share_at(assumed), assumed, measured, kAlbedo, patterns, PhaseSource::Finest);
      EXPECT_NEAR(found.phase_rad, kTrue_rad, 1e-4) << indirect_rad << ' ' << assumed;
    }
  }
}

TEST(LitSurface, CountsDirectionsThroughHolesAsUnknown) {
  Mesh walls = right_angle();
  std::erase_if(walls.triangles, [&](const Mesh::Triangle& triangle) {
    return walls.vertices_mm[triangle[0]].x() >= 0.0F && walls.vertices_mm[triangle[0]].x() < 5.0F;
  });
  // The back of the part, whose outside is away from the projector.
  const auto first = static_cast<std::uint32_t>(walls.vertices_mm.size());
  for (const auto& [x, y] : {std::pair{-500.0F, -500.0F}, {500.0F, -500.0F}, {0.0F, 900.0F}})
    walls.vertices_mm.emplace_back(x, y, static_cast<float>(kFar_mm) + 50.0F);
  walls.triangles.push_back({first, first + 1, first + 2});
  const auto patterns = patterns_with({200.0});
  const LitSurface surface(walls, far_projector(), patterns);
  const LitSurface whole(right_angle(), far_projector(), patterns);
  double distance = 0.0;
  const Eigen::Vector3d near_crease(-2.0 / kFar_mm, 0.0, 1.0);
  const auto at = [&](const LitSurface& lit) {
    return lit.light_along(
        Eigen::Isometry3d::Identity(), Eigen::Vector3d::Zero(), near_crease, distance);
  };
  const PointLight holed = at(surface);
  ASSERT_GT(holed.direct, 0.0);
  EXPECT_GT(holed.unknown, 0.02 * holed.direct);
  EXPECT_EQ(at(whole).unknown, 0.0);
}

}  // namespace
}  // namespace frangia
