#include "frangia/inspect/internal/vertex_use.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/inspect/internal/shading.h"

namespace frangia {
namespace {

/// A square of 4 by 4 cells of 1 mm in z = 0; vertex (x, y) is 5 y + x.
Mesh square_grid() {
  Mesh mesh;
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 5; ++x)
      mesh.vertices_mm.emplace_back(static_cast<float>(x), static_cast<float>(y), 0.0F);
  }
  for (std::uint32_t y = 0; y < 4; ++y) {
    for (std::uint32_t x = 0; x < 4; ++x) {
      const std::uint32_t a = 5 * y + x;
      mesh.triangles.push_back({a, a + 1, a + 6});
      mesh.triangles.push_back({a, a + 6, a + 5});
    }
  }
  return mesh;
}

TEST(BoundaryFlags, MarkTheVerticesAroundTheSquare) {
  const auto flags = boundary_flags(square_grid());
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 5; ++x) {
      const bool edge = x == 0 || y == 0 || x == 4 || y == 4;
      EXPECT_EQ(flags[static_cast<std::size_t>(5 * y + x)], edge ? 1 : 0) << x << y;
    }
  }
}

TEST(VertexUses, TellMeasuredSynthesizedBoundaryAndUnusedVertices) {
  Mesh mesh = square_grid();
  mesh.vertices_mm.emplace_back(9.0F, 9.0F, 9.0F);  // of no triangle
  mesh.triangle_marks.assign(32, Mark::Measured);
  for (std::size_t t = 0; t < 32; ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (a == 6 || b == 6 || c == 6) mesh.triangle_marks[t] = Mark::Synthesized;
  }
  mesh.vertex_marks.assign(26, Mark::Measured);
  mesh.vertex_marks[18] = Mark::Synthesized;
  mesh.vertices_mm[17].z() = std::numeric_limits<float>::quiet_NaN();
  const auto uses = vertex_uses(mesh);
  EXPECT_EQ(uses[6], VertexUse::Synthesized) << "all of its triangles";
  EXPECT_EQ(uses[7], VertexUse::Measured) << "some of its triangles";
  EXPECT_EQ(uses[12], VertexUse::Measured);
  EXPECT_EQ(uses[18], VertexUse::Synthesized);
  EXPECT_EQ(uses[17], VertexUse::Unused) << "not finite";
  EXPECT_EQ(uses[25], VertexUse::Unused);
  EXPECT_EQ(uses[2], VertexUse::MeshEdge);
  EXPECT_EQ(uses[20], VertexUse::MeshEdge);
}

TEST(SharpEdgeFlags, MarkNormalsAtMoreThanTheAngleFromATriangle) {
  const Mesh mesh = square_grid();
  std::vector<Eigen::Vector3f> normals(25, Eigen::Vector3f::UnitZ());
  const auto tilted = [](double deg) -> Eigen::Vector3f {
    return Eigen::Vector3d(std::sin(rad_from_deg(deg)), 0.0, std::cos(rad_from_deg(deg)))
        .cast<float>();
  };
  normals[6] = tilted(29.0);
  normals[12] = tilted(31.0);
  normals[13] = -Eigen::Vector3f::UnitZ();
  auto flags = sharp_edge_flags(mesh, normals);
  EXPECT_EQ(flags[6], 0);
  EXPECT_EQ(flags[12], 1);
  EXPECT_EQ(flags[13], 1);
  EXPECT_EQ(std::accumulate(flags.begin(), flags.end(), 0), 2);
  flags = sharp_edge_flags(mesh, normals, rad_from_deg(28.0));
  EXPECT_EQ(std::accumulate(flags.begin(), flags.end(), 0), 3);
}

TEST(VertexAreas, AreAThirdOfTheTrianglesOfEachVertex) {
  Mesh mesh = square_grid();
  for (Eigen::Vector3f& vertex : mesh.vertices_mm)
    vertex *= 2.0F;  // triangles of 2 mm2
  std::vector<double> areas = vertex_areas(mesh);
  EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), 64.0, 1e-9);
  EXPECT_NEAR(areas[12], 6.0 * 2.0 / 3.0, 1e-9);
  EXPECT_NEAR(areas[0], 2.0 * 2.0 / 3.0, 1e-9);
  EXPECT_NEAR(areas[4], 1.0 * 2.0 / 3.0, 1e-9);
  mesh.vertices_mm[24].x() = std::numeric_limits<float>::quiet_NaN();
  areas = vertex_areas(mesh);
  EXPECT_NEAR(areas[18], 4.0 * 2.0 / 3.0, 1e-9) << "without the triangles that have no area";
  EXPECT_EQ(areas[24], 0.0);
}

/// The place in the picture of a point of the mesh, in halves of its shorter side from the centre.
Eigen::Vector2d place_of(const Viewpoint& viewpoint, const Eigen::Vector3d& point) {
  const Eigen::Vector3d p = viewpoint.axes * (point - viewpoint.target);
  const double depth =
      viewpoint.perspective ? (viewpoint.distance - p.z()) / viewpoint.distance : 1.0;
  return p.head<2>() / depth / viewpoint.scale;
}

TEST(FitViewpoint, FillsThePictureAndLooksFromItsAngles) {
  const Mesh mesh = square_grid();
  for (const bool perspective : {true, false}) {
    for (const auto& [width, height] : {std::pair(400, 200), std::pair(200, 400)}) {
      RenderOptions options;
      options.width_px = width;
      options.height_px = height;
      options.azimuth_rad = 0.4;
      options.elevation_rad = 0.7;
      options.perspective = perspective;
      const Viewpoint viewpoint = fit_viewpoint(mesh, options);
      const Eigen::Vector3d towards(
          std::cos(0.7) * std::cos(0.4), std::cos(0.7) * std::sin(0.4), std::sin(0.7));
      EXPECT_LT((viewpoint.axes.row(2).transpose() - towards).norm(), 1e-12);
      EXPECT_NEAR(viewpoint.axes.row(0).z(), 0.0, 1e-12);
      EXPECT_GT(viewpoint.axes(1, 2), 0.0);
      EXPECT_NEAR(viewpoint.axes.determinant(), 1.0, 1e-12);
      double filled = 0.0;
      for (const auto& vertex : mesh.vertices_mm) {
        const Eigen::Vector2d place = place_of(viewpoint, vertex.cast<double>());
        const double shorter = std::min(width, height);
        filled = std::max({filled,
                           std::abs(place.x()) * shorter / width,
                           std::abs(place.y()) * shorter / height});
        // The ray through the place meets the point.
        const Viewpoint::Ray ray = viewpoint.ray(place.x(), place.y());
        const Eigen::Vector3d away = vertex.cast<double>() - ray.origin;
        const double along = ray.direction.dot(away);
        EXPECT_GT(along, 0.0);
        EXPECT_NEAR(away.squaredNorm(), along * along, 1e-6);
        EXPECT_NEAR(ray.direction.norm(), 1.0, 1e-12);
      }
      EXPECT_NEAR(filled, 0.86, 1e-6);
    }
  }
}

TEST(FitViewpoint, FitsTheGivenPointsInstead) {
  RenderOptions options;
  options.fit_to_mm = {{-50.0F, 0.0F, 0.0F}, {150.0F, 40.0F, 10.0F}, {0.0F, 90.0F, 0.0F}};
  const Mesh mesh = square_grid();
  const double of_mesh = fit_viewpoint(mesh, {}).distance;
  EXPECT_GT(fit_viewpoint(mesh, options).distance, 20.0 * of_mesh);
}

}  // namespace
}  // namespace frangia
