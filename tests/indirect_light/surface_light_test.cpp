#include "frangia/indirect_light/surface_light.h"

#include <cmath>
#include <complex>
#include <memory>

#include <gtest/gtest.h>

#include "support/test_meshes.h"
#include "support/two_walls.h"

namespace frangia {
namespace {

constexpr double kDepth_mm = testing::kWallsFar_mm;

std::vector<Pattern> two_patterns() {
  std::vector<Pattern> out{{.name = "coarse", .period_px = 200.0},
                           {.name = "fine", .period_px = 16.0}};
  for (Pattern& pattern : out)
    pattern.shifts_rad = {0.0, 1.0, 2.0};
  return out;
}

/// A grid of `size` x `size` squares of 1 mm about x = 0, at a height that depends on x.
template <typename Height>
Mesh sheet(int size, const Height& height) {
  Mesh mesh;
  for (int y = 0; y <= size; ++y) {
    for (int x = 0; x <= size; ++x) {
      const float at = static_cast<float>(x) - 0.5F * static_cast<float>(size);
      mesh.vertices_mm.emplace_back(at,
                                    static_cast<float>(y) - 0.5F * static_cast<float>(size),
                                    static_cast<float>(kDepth_mm) - height(at));
    }
  }
  const auto row = static_cast<std::uint32_t>(size + 1);
  for (std::uint32_t y = 0; y + 1 < row; ++y) {
    for (std::uint32_t x = 0; x + 1 < row; ++x) {
      const std::uint32_t i = y * row + x;
      mesh.triangles.push_back({i, i + row, i + 1});
      mesh.triangles.push_back({i + 1, i + row, i + row + 1});
    }
  }
  return mesh;
}

std::shared_ptr<const LitSurface> under_projector(Mesh mesh) {
  return std::make_shared<const LitSurface>(
      std::move(mesh), testing::far_projector(), two_patterns());
}

std::vector<Eigen::Isometry3d> two_poses() {
  Eigen::Isometry3d turned = Eigen::Isometry3d::Identity();
  turned.translate(Eigen::Vector3d(0.0, 0.0, kDepth_mm));
  turned.rotate(Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitY()));
  turned.translate(Eigen::Vector3d(0.0, 0.0, -kDepth_mm));
  return {Eigen::Isometry3d::Identity(), turned};
}

TEST(SurfaceLight, CollectsNothingOnASphereAPlaneOrARidge) {
  const auto poses = two_poses();
  const Mesh sphere = testing::sphere({0.0, 0.0, kDepth_mm}, 40.0);
  EXPECT_EQ(SurfaceLight(under_projector(sphere), poses).receivers(), 0U);
  const Mesh plane = sheet(40, [](float) { return 0.0F; });
  EXPECT_EQ(SurfaceLight(under_projector(plane), poses).receivers(), 0U);
  const Mesh ridge = sheet(40, [](float x) { return -std::abs(x); });
  EXPECT_EQ(SurfaceLight(under_projector(ridge), poses).receivers(), 0U);
}

TEST(SurfaceLight, CollectsLightOnlyWhereTheSurfaceSeesItself) {
  // A groove in a wide plane.
  const Mesh groove =
      sheet(120, [](float x) { return std::abs(x) < 6.0F ? std::abs(x) - 6.0F : 0.0F; });
  const SurfaceLight light(under_projector(groove), two_poses());
  EXPECT_GT(light.receivers(), 0U);
  // 13 of 121 columns of vertices, and the corners of the triangles at three creases.
  EXPECT_LT(light.receivers(), groove.vertices_mm.size() / 4);
}

TEST(SurfaceLight, IsThatOfEachPointInEachPose) {
  const auto surface = under_projector(sheet(60, [](float x) { return std::abs(x); }));
  const auto poses = two_poses();
  const SurfaceLight light(surface, poses);
  for (std::size_t pose = 0; pose < poses.size(); ++pose) {
    EXPECT_EQ(light.pose_of(poses[pose]), pose);
    for (const double x_mm : {-21.3, -9.2, -2.6, 1.4, 5.7, 13.1}) {
      const Eigen::Vector3d origin = poses[pose].inverse().translation();
      const Eigen::Vector3d at(x_mm, 0.3, kDepth_mm - std::abs(x_mm));
      double exact_mm = 0.0;
      double found_mm = 0.0;
      const PointLight exact = surface->light_along(poses[pose], origin, at - origin, exact_mm);
      const PointLight found = light.light_along(pose, origin, at - origin, found_mm);
      ASSERT_GT(exact.direct, 0.0);
      EXPECT_EQ(found_mm, exact_mm);
      EXPECT_EQ(found.direct, exact.direct);
      const double direct = exact.direct;
      EXPECT_NEAR(found.indirect / direct, exact.indirect / direct, 0.015) << x_mm << ' ' << pose;
      for (std::size_t m = 0; m < 2; ++m) {
        // A tenth of the largest: within a triangle near the crease light bends.
        EXPECT_LT(std::abs(found.fringes[m] - exact.fringes[m]) / direct, 0.04)
            << x_mm << ' ' << pose << ' ' << m;
      }
    }
  }
}

}  // namespace
}  // namespace frangia
