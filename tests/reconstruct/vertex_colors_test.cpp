// Colors of a mesh from simulated frames, against the color of the simulated surface.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/statistics.h"
#include "frangia/geometry/vertex_data.h"
#include "frangia/reconstruct/merge_scans.h"
#include "frangia/reconstruct/reconstruct.h"

#include "support/small_scan.h"
#include "support/temporary_folder.h"
#include "support/test_meshes.h"

namespace frangia::vertex_colors {
namespace {

constexpr double kStrength = 0.8;

/// Red, green and blue of the simulated surface: bands along a skew direction, 40 mm wide.
Eigen::Vector3d surface_at(const Eigen::Vector3f& p) {
  const double phase = kTwoPi * Eigen::Vector3d(0.48, 0.36, 0.8).dot(p.cast<double>()) / 40.0;
  Eigen::Vector3d color;
  for (int i = 0; i < 3; ++i)
    color[i] = 1.0 - kStrength * (0.5 + 0.5 * std::cos(phase + kTwoPi * i / 3.0));
  return color;
}

/// IEC 61966-2-1.
double light_of(std::uint8_t screen) {
  const double v = screen / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

Eigen::Vector3d light_of(const VertexColor& color) {
  return {light_of(color[0]), light_of(color[1]), light_of(color[2])};
}

class ColoredScan : public ::testing::Test {
 protected:
  [[nodiscard]] Scan scan(const PatternPlan& patterns, double color, double ambient) const {
    Scan plan;
    plan.folder = folder_.path() / "scan";
    plan.name = "ball-bar";
    plan.rig = testing::small_rig("digital", 3);
    plan.patterns = default_patterns(plan.rig, patterns);
    for (int i = 0; i < 3; ++i)
      plan.views.push_back({kTwoPi * i / 8, "views/" + std::to_string(i)});
    static_cast<void>(simulate_scan(
        make_part("ball-bar"), plan, {.samples_per_px = 1, .ambient = ambient, .color = color}));
    return read_scan(plan.folder);
  }

 private:
  testing::TemporaryFolder folder_;
};

/// Median angle between the colors of the vertices and those of the surface, in the space of linear
/// red, green and blue: independent of the brightness.
double median_angle(const Mesh& mesh) {
  EXPECT_EQ(mesh.colors.size(), mesh.vertices_mm.size());
  std::vector<double> angles;
  for (std::size_t i = 0; i < mesh.colors.size(); ++i) {
    const Eigen::Vector3d found = light_of(mesh.colors[i]);
    if (found.norm() < 0.1) continue;  // grazing light
    const Eigen::Vector3d truth = surface_at(mesh.vertices_mm[i]).normalized();
    angles.push_back(std::acos(std::min(1.0, found.normalized().dot(truth))));
  }
  EXPECT_GT(2 * angles.size(), mesh.colors.size());
  return median(std::move(angles));
}

TEST_F(ColoredScan, GivesTheMeshTheColorsOfItsWhiteFrames) {
  const Reconstruction result = reconstruct(scan({.white = true, .dark = true}, kStrength, 0.2));
  EXPECT_LT(median_angle(result.mesh), rad_from_deg(1.0));
}

TEST_F(ColoredScan, IsGreyWithoutWhiteFrames) {
  const Mesh mesh = reconstruct(scan({}, kStrength, 0.0)).mesh;
  ASSERT_EQ(mesh.colors.size(), mesh.vertices_mm.size());
  double darkest = 1.0;
  double brightest = 0.0;
  for (const VertexColor& color : mesh.colors) {
    ASSERT_EQ(color[0], color[1]);
    ASSERT_EQ(color[0], color[2]);
    darkest = std::min(darkest, light_of(color[0]));
    brightest = std::max(brightest, light_of(color[0]));
  }
  // Half of the light of a white frame: the brightest pixel of any frame has 80 % of full scale.
  EXPECT_GT(brightest, 0.3);
  EXPECT_LT(brightest, 0.6);
  EXPECT_LT(darkest, 0.1);
}

TEST_F(ColoredScan, HasNoColorsIfNoneAreAskedFor) {
  EXPECT_TRUE(reconstruct(scan({.white = true}, kStrength, 0.0), {.colors = FrameColors::None})
                  .mesh.colors.empty());
}

/// The color of a point of a ball of radius 20.
VertexColor ball_color(const Eigen::Vector3f& p) {
  const auto channel = [](float v) {
    return static_cast<std::uint8_t>(std::lround(128.0F + 5.0F * v));
  };
  return {channel(p.x()), channel(p.y()), channel(p.z())};
}

/// The part of a coloured ball that is seen from a direction.
RangeScan ball_scan(const Eigen::Vector3f& from) {
  RangeScan scan;
  scan.mesh = testing::sphere({0.0, 0.0, 0.0}, 20.0, 60);
  for (const auto& vertex : scan.mesh.vertices_mm)
    scan.mesh.colors.push_back(ball_color(vertex));
  std::vector<std::uint8_t> keep;
  for (const auto& t : scan.mesh.triangles)
    keep.push_back(scan.mesh.vertices_mm[t[0]].normalized().dot(from) > 0.4F ? 1 : 0);
  keep_triangles(scan.mesh, keep);
  return scan;
}

TEST(MergedScans, KeepTheColorsOfTheirPoints) {
  std::vector<RangeScan> scans;
  for (const Eigen::Vector3f& from :
       {Eigen::Vector3f(1.0F, 0.0F, 0.0F), Eigen::Vector3f(0.0F, 1.0F, 0.0F)})
    scans.push_back(ball_scan(from));
  const Mesh mesh = merge_scans(scans, {.poses = ScanPoses::Given, .register_poses = false}).mesh;
  ASSERT_EQ(mesh.colors.size(), mesh.vertices_mm.size());
  double square = 0.0;
  for (std::size_t i = 0; i < mesh.colors.size(); ++i) {
    const VertexColor truth = ball_color(mesh.vertices_mm[i]);
    for (std::size_t c = 0; c < 3; ++c)
      square += std::pow(int{mesh.colors[i].at(c)} - int{truth.at(c)}, 2) / 3.0;
  }
  EXPECT_LT(std::sqrt(square / static_cast<double>(mesh.colors.size())), 3.0);
}

}  // namespace
}  // namespace frangia::vertex_colors
