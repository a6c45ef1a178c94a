// Colors of vertices against surfaces whose color is known at every point.
#include "frangia/fusion/color_vertices.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/fusion/fuse_views.h"

#include "support/analytic_views.h"

namespace frangia::colored_surfaces {
namespace {

using testing::look_from;
using testing::small_camera_model;

constexpr double kDistance = 650.0;
constexpr int kSize_px = 200;

/// The color of a point, from its position in the object frame and the number of the view.
using Paint = std::function<PixelColor(const Eigen::Vector3d& point_mm, std::size_t view)>;

/// Views of a shape whose pixels have the color of the point that they see.
ViewStore painted_views(const testing::Shape& shape,
                        const std::vector<Eigen::Isometry3d>& poses,
                        const Paint& paint) {
  const CameraModel model = small_camera_model(kSize_px);
  const auto rays = rays_of(model);
  ViewStore views;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    View view = testing::snapshot(shape, model, poses[i], {.seed = static_cast<unsigned>(i)});
    view.color = Image<PixelColor>(kSize_px, kSize_px, PixelColor{0, 255, 0});
    for (int y = 0; y < kSize_px; ++y) {
      for (int x = 0; x < kSize_px; ++x) {
        const double z = static_cast<double>(view.range.depth_mm(x, y));
        if (std::isnan(z)) continue;
        const Eigen::Vector3d ray = rays(x, y).cast<double>().homogeneous();
        view.color(x, y) = paint(poses[i].inverse() * (z * ray), i);
      }
    }
    views.add(view);
  }
  return views;
}

Mesh colored_surface(const ViewStore& views) {
  Mesh mesh = fuse_views(views, small_camera_model(kSize_px), {.voxel_mm = 1.0});
  color_vertices(mesh, views, small_camera_model(kSize_px));
  return mesh;
}

/// A smooth pattern on a sphere.
PixelColor stripes(const Eigen::Vector3d& p) {
  const auto channel = [](double v) { return static_cast<std::uint8_t>(128 + 100 * std::sin(v)); };
  return {channel(p.x() / 6.0), channel(p.y() / 6.0), channel(p.z() / 6.0)};
}

TEST(ColorVertices, BlendsTheColorsThatTheViewsSee) {
  const auto views = painted_views(testing::sphere(20.0),
                                   testing::all_around(8, kDistance),
                                   [](const auto& p, std::size_t) { return stripes(p); });
  const Mesh mesh = colored_surface(views);
  ASSERT_EQ(mesh.colors.size(), mesh.vertices_mm.size());
  double square = 0.0;
  for (std::size_t i = 0; i < mesh.colors.size(); ++i) {
    const PixelColor truth = stripes(mesh.vertices_mm[i].cast<double>());
    for (std::size_t c = 0; c < 3; ++c)
      square += std::pow(mesh.colors[i].at(c) - truth.at(c), 2) / 3.0;
  }
  // A pixel sees 0.43 mm, in which a channel changes by up to 7.
  EXPECT_LT(std::sqrt(square / static_cast<double>(mesh.colors.size())), 2.0);
}

TEST(ColorVertices, LeavesNoSeamWhereViewsOfOtherBrightnessEnd) {
  const auto views =
      painted_views(testing::sphere(20.0),
                    testing::around_table(6, 0.4, kDistance),
                    [](const auto&, std::size_t view) {
                      return view % 2 == 0 ? PixelColor{120, 120, 120} : PixelColor{180, 180, 180};
                    });
  const Mesh mesh = colored_surface(views);
  int largest = 0;
  int low = 255;
  int high = 0;
  for (const auto& t : mesh.triangles) {
    // Where the edges of several views meet, below, any blend changes within a few pixels.
    if (mesh.vertices_mm[t[0]].z() < -5.0F) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = mesh.colors[t.at(i)][0];
      const int b = mesh.colors[t.at((i + 1) % 3)][0];
      largest = std::max(largest, std::abs(a - b));
      low = std::min(low, a);
      high = std::max(high, a);
    }
  }
  EXPECT_LE(low, 122);
  EXPECT_GE(high, 178);
  EXPECT_LE(largest, 15) << "of 60: no neighbours differ by a quarter of the step";
}

TEST(ColorVertices, IgnoresViewsFromWhichAVertexIsHidden) {
  // A red ball above a blue floor. The floor behind the ball is hidden from the oblique view.
  const auto shape = testing::both(testing::sphere(8.0, {0.0, 0.0, 14.0}), testing::floor_at(0.0));
  const auto paint = [](const Eigen::Vector3d& p, std::size_t) {
    return p.z() > 3.0 ? PixelColor{255, 0, 0} : PixelColor{0, 0, 255};
  };
  const auto views =
      painted_views(shape, {look_from(0.0, 0.7, kDistance), look_from(0.0, 1.5, kDistance)}, paint);
  const Mesh mesh = colored_surface(views);
  std::size_t floor = 0;
  for (std::size_t i = 0; i < mesh.colors.size(); ++i) {
    if (std::abs(mesh.vertices_mm[i].z()) > 0.2F) continue;
    ++floor;
    EXPECT_EQ(mesh.colors[i][0], 0) << mesh.vertices_mm[i].transpose();
    EXPECT_EQ(mesh.colors[i][2], 255);
  }
  EXPECT_GT(floor, 1000U);
}

TEST(ColorVertices, GivesVerticesThatNoViewSeesTheColorOfTheirNeighbours) {
  const auto views = painted_views(
      testing::sphere(20.0), {look_from(0.0, 0.0, kDistance)}, [](const auto&, std::size_t) {
        return PixelColor{9, 90, 30};
      });
  Mesh mesh = fuse_views(views, small_camera_model(kSize_px), {.voxel_mm = 1.0});
  // A strip of triangles away from the surface, joined to its first vertex, and a part of its own.
  const auto first = static_cast<std::uint32_t>(mesh.vertices_mm.size());
  const auto add = [&](float x) {
    mesh.vertices_mm.emplace_back(x, 90.0F, 0.0F);
    mesh.normals.emplace_back(1.0F, 0.0F, 0.0F);
    mesh.sigma_mm.push_back(0.1F);
    mesh.views.push_back(0);
  };
  for (const float x : {1.0F, 2.0F, 3.0F, 50.0F, 51.0F, 52.0F})
    add(x);
  mesh.triangles.push_back({0, first, first + 1});
  mesh.triangles.push_back({first, first + 2, first + 1});
  mesh.triangles.push_back({first + 3, first + 4, first + 5});
  color_vertices(mesh, views, small_camera_model(kSize_px));
  for (std::uint32_t i = 0; i < first + 3; ++i)
    EXPECT_EQ(mesh.colors[i], (VertexColor{9, 90, 30})) << i;
  EXPECT_EQ(mesh.colors.back(), kUnknownColor);
}

TEST(ColorVertices, LeavesAMeshWithoutColorsWhereNoViewHasAny) {
  const auto views = testing::snapshots(
      testing::sphere(20.0), small_camera_model(kSize_px), {look_from(0.0, 0.0, kDistance)});
  EXPECT_TRUE(colored_surface(views).colors.empty());
}

}  // namespace
}  // namespace frangia::colored_surfaces
