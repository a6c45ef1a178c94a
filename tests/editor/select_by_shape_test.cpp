// The selections by place, direction and vertex data.
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/editor/internal/select_by_geometry.h"
#include "frangia/editor/internal/select_by_vertex_data.h"

#include "support/error_of.h"

namespace frangia {
namespace {

/// A band of 4 by 20 cells about a cylinder of this radius, outside out; open at both ends.
Mesh band(float radius, int around = 20, int along = 4) {
  Mesh mesh;
  for (int k = 0; k <= along; ++k) {
    for (int i = 0; i < around; ++i) {
      const auto angle = static_cast<float>(kTwoPi * i / around);
      mesh.vertices_mm.emplace_back(
          radius * std::cos(angle), radius * std::sin(angle), static_cast<float>(k));
    }
  }
  for (int k = 0; k < along; ++k) {
    for (int i = 0; i < around; ++i) {
      const auto at = [&](int u, int v) {
        return static_cast<std::uint32_t>(v * around + u % around);
      };
      mesh.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  }
  return mesh;
}

Eigen::Vector3d centroid(const Mesh& mesh, std::size_t i) {
  const auto& [a, b, c] = mesh.triangles[i];
  return ((mesh.vertices_mm[a] + mesh.vertices_mm[b] + mesh.vertices_mm[c]) / 3.0F).cast<double>();
}

TEST(SelectByGeometry, TakesTrianglesByTheirCentroids) {
  const Mesh mesh = band(10.0F);
  const Eigen::Hyperplane<double, 3> plane(Eigen::Vector3d(0.6, 0.0, 0.8), -3.0);
  const Eigen::AlignedBox3d box(Eigen::Vector3d(-4.0, -20.0, 0.5), Eigen::Vector3d(20.0, 6.0, 3.5));
  const Eigen::Vector3d center(8.0, 2.0, 1.0);
  const Selection by_plane = select_by_plane(mesh, plane);
  const Selection by_box = select_by_box(mesh, box);
  const Selection by_ball = select_by_ball(mesh, center, 5.0);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Eigen::Vector3d at = centroid(mesh, i);
    EXPECT_EQ(by_plane[i], 0.6 * at.x() + 0.8 * at.z() > 3.0 ? 1 : 0);
    EXPECT_EQ(
        by_box[i],
        at.x() > -4.0 && at.x() < 20.0 && at.y() < 6.0 && at.z() > 0.5 && at.z() < 3.5 ? 1 : 0);
    EXPECT_EQ(by_ball[i], (at - center).norm() < 5.0 ? 1 : 0);
  }
  for (const Selection* one : {&by_plane, &by_box, &by_ball}) {
    const int count = std::accumulate(one->begin(), one->end(), 0);
    EXPECT_GT(count, 10);
    EXPECT_LT(count, 150);
  }
}

TEST(SelectByNormal, TakesTrianglesWithinAnAngleOfADirection) {
  Mesh mesh = band(10.0F);  // cell i faces 18 i + 9 degrees
  const Selection found = select_by_normal(mesh, {2.0, 0.0, 0.0}, rad_from_deg(30.0));
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::size_t cell = i / 2 % 20;
    EXPECT_EQ(found[i], cell < 2 || cell > 17 ? 1 : 0) << cell;
  }
  mesh.triangles[0] = {0, 0, 1};  // without area
  EXPECT_EQ(select_by_normal(mesh, Eigen::Vector3d::UnitX(), kPi)[0], 0);
  EXPECT_EQ(select_by_normal(mesh, Eigen::Vector3d::UnitX(), kPi)[1], 1);
  EXPECT_NE(testing::error_of([&] {
              static_cast<void>(select_by_normal(mesh, Eigen::Vector3d::Zero(), 1.0));
            }).find("no length"),
            std::string::npos);
}

TEST(SelectByVertexData, TakesTrianglesWithOneVertexBeyondTheLimit) {
  Mesh mesh = band(10.0F);
  mesh.sigma_mm.assign(100, 0.1F);
  mesh.sigma_mm[50] = 0.3F;
  mesh.sigma_mm[30] = std::numeric_limits<float>::quiet_NaN();
  mesh.views.assign(100, 5);
  mesh.views[50] = 3;
  mesh.views[30] = 4;
  const Selection by_sigma = select_by_sigma(mesh, 0.2);
  const Selection by_views = select_by_views(mesh, 4);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    const bool at_50 = a == 50 || b == 50 || c == 50;
    const bool at_30 = a == 30 || b == 30 || c == 30;
    EXPECT_EQ(by_sigma[i], at_50 || at_30 ? 1 : 0);
    EXPECT_EQ(by_views[i], at_50 ? 1 : 0);
  }
  mesh.triangle_marks.assign(mesh.triangles.size(), Mark::Measured);
  mesh.triangle_marks[7] = Mark::Synthesized;
  const Selection by_mark = select_by_mark(mesh, Mark::Synthesized);
  EXPECT_EQ(std::accumulate(by_mark.begin(), by_mark.end(), 0), 1);
  EXPECT_EQ(by_mark[7], 1);
  mesh.sigma_mm.clear();
  mesh.views.clear();
  EXPECT_NE(
      testing::error_of([&] { static_cast<void>(select_by_sigma(mesh, 0.2)); }).find("sigma_mm"),
      std::string::npos);
  EXPECT_NE(
      testing::error_of([&] { static_cast<void>(select_by_views(mesh, 2)); }).find("view counts"),
      std::string::npos);
}

TEST(MeanCurvature, OfACylinderIsHalfTheInverseOfItsRadius) {
  for (const float radius : {5.0F, 20.0F}) {
    const Mesh outside = band(radius, 60, 6);
    Mesh inside = outside;
    for (auto& triangle : inside.triangles)
      std::swap(triangle[1], triangle[2]);
    const auto convex = mean_curvature_per_mm(outside);
    const auto concave = mean_curvature_per_mm(inside);
    for (std::size_t v = 0; v < convex.size(); ++v) {
      const bool boundary = v < 60 || v >= 360;
      EXPECT_EQ(std::isnan(convex[v]), boundary);
      if (boundary) continue;
      EXPECT_NEAR(convex[v], 0.5F / radius, 0.01F / radius);
      EXPECT_NEAR(concave[v], -0.5F / radius, 0.01F / radius);
    }
    const auto count = [&](double above) {
      const Selection found = select_by_curvature(inside, above);
      return std::accumulate(found.begin(), found.end(), std::size_t{0});
    };
    EXPECT_EQ(count(0.48 / static_cast<double>(radius)), inside.triangles.size())
        << "all touch an inner vertex";
    EXPECT_EQ(count(0.52 / static_cast<double>(radius)), 0U);
  }
}

}  // namespace
}  // namespace frangia
