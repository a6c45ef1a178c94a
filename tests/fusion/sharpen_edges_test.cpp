#include "frangia/fusion/internal/sharpen_edges.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <gtest/gtest.h>

namespace frangia {
namespace {

/// A point of a profile across an edge, and its normal.
struct Step {
  Eigen::Vector2f point;
  Eigen::Vector2f out;
};

/// Face z = 0 for x < 0, and face x = 0 for z < 0: points at 1 to 9 from the edge, and `between` in
/// the middle.
std::vector<Step> profile(const std::vector<Step>& between) {
  std::vector<Step> steps;
  for (int i = 9; i > 0; --i)
    steps.push_back({{static_cast<float>(-i), 0.0F}, {0.0F, 1.0F}});
  steps.insert(steps.end(), between.begin(), between.end());
  for (int i = 1; i < 10; ++i)
    steps.push_back({{0.0F, static_cast<float>(-i)}, {1.0F, 0.0F}});
  return steps;
}

/// The edge with a chamfer at 0.3.
std::vector<Step> chamfer() {
  const float half = std::sqrt(0.5F);
  return profile({{{-0.3F, 0.0F}, {half, half}}, {{0.0F, -0.3F}, {half, half}}});
}

/// A profile extruded along y, with vertices one apart.
Mesh extruded(const std::vector<Step>& steps, int rows) {
  Mesh mesh;
  for (int row = 0; row < rows; ++row) {
    for (const Step& step : steps) {
      mesh.vertices_mm.emplace_back(step.point.x(), static_cast<float>(row), step.point.y());
      mesh.normals.emplace_back(step.out.x(), 0.0F, step.out.y());
    }
  }
  const auto width = static_cast<std::uint32_t>(steps.size());
  for (std::uint32_t row = 0; row + 1 < static_cast<std::uint32_t>(rows); ++row) {
    for (std::uint32_t i = 0; i + 1 < width; ++i) {
      const std::uint32_t a = row * width + i;
      mesh.triangles.push_back({a, a + 1, a + width + 1});
      mesh.triangles.push_back({a, a + width + 1, a + width});
    }
  }
  mesh.sigma_mm.assign(mesh.vertices_mm.size(), 0.005F);
  mesh.views.assign(mesh.vertices_mm.size(), 3);
  return mesh;
}

/// The largest distance of the centres of triangles in the middle rows from the nearer face.
float farthest_off(const Mesh& mesh, float rows) {
  float farthest = 0.0F;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3f middle =
        (mesh.vertices_mm[t[0]] + mesh.vertices_mm[t[1]] + mesh.vertices_mm[t[2]]) / 3.0F;
    if (middle.y() < 3.0F || middle.y() > rows - 4.0F) continue;
    farthest = std::max(farthest, std::min(std::abs(middle.x()), std::abs(middle.z())));
  }
  return farthest;
}

TEST(SharpenEdges, ExtrapolatesFacesToWhereTheyIntersect) {
  Mesh mesh = extruded(chamfer(), 30);
  ASSERT_GT(farthest_off(mesh, 30.0F), 0.09F);
  const auto sharp = sharpen_edges(mesh, 1.0F);
  EXPECT_LT(farthest_off(mesh, 30.0F), 1e-3F);
  ASSERT_EQ(sharp.size(), mesh.vertices_mm.size());
  EXPECT_GT(std::count(sharp.begin(), sharp.end(), 1), 24);
  for (std::size_t i = 0; i < sharp.size(); ++i) {
    if (sharp[i] == 0) continue;
    EXPECT_LT(std::hypot(mesh.vertices_mm[i].x(), mesh.vertices_mm[i].z()), 1e-3F);
  }
}

TEST(SharpenEdges, CountsHowFarItMovesTheSurface) {
  // A chamfer that the points do not resolve looks alike: its middle lies 0.21 below the edge.
  Mesh mesh = extruded(chamfer(), 30);
  const auto sharp = sharpen_edges(mesh, 1.0F);
  for (std::size_t i = 0; i < sharp.size(); ++i) {
    if (sharp[i] == 0) continue;
    EXPECT_GT(mesh.sigma_mm[i], 0.05F);
    EXPECT_LT(mesh.sigma_mm[i], 0.2F);
  }
  EXPECT_EQ(mesh.sigma_mm[0], 0.005F);
}

TEST(SharpenEdges, StaysManifold) {
  Mesh mesh = extruded(chamfer(), 30);
  sharpen_edges(mesh, 1.0F);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_EQ(++uses[std::pair(t[i], t[(i + 1) % 3])], 1);
  }
  EXPECT_EQ(mesh.normals.size(), mesh.vertices_mm.size());
  EXPECT_EQ(mesh.sigma_mm.size(), mesh.vertices_mm.size());
  EXPECT_EQ(mesh.views.size(), mesh.vertices_mm.size());
}

TEST(SharpenEdges, LeavesARoundEdgeRound) {
  std::vector<Step> round;
  constexpr int kSteps = 4;
  for (int i = 0; i <= kSteps; ++i) {
    const float turn = 1.5708F * static_cast<float>(i) / kSteps;
    const Eigen::Vector2f out(std::sin(turn), std::cos(turn));
    round.push_back({2.5F * out, out});
  }
  std::vector<Step> steps = profile({});
  for (auto& step : steps)
    step.point += step.out.x() == 0.0F ? Eigen::Vector2f(0.0F, 2.5F) : Eigen::Vector2f(2.5F, 0.0F);
  steps.insert(steps.begin() + 9, round.begin(), round.end());
  Mesh mesh = extruded(steps, 30);
  const auto before = mesh.vertices_mm;
  sharpen_edges(mesh, 1.0F);
  EXPECT_EQ(mesh.vertices_mm, before);
}

TEST(SharpenEdges, LeavesAFoldTooShortToBeAnEdge) {
  Mesh mesh = extruded(chamfer(), 7);
  const auto before = mesh.triangles;
  sharpen_edges(mesh, 1.0F);
  EXPECT_EQ(mesh.triangles, before);
}

}  // namespace
}  // namespace frangia
