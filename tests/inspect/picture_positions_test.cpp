// Where places of a mesh are in its picture.
#include <gtest/gtest.h>

#include "frangia/inspect/render_mesh.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// The center of the pixels that a picture shows in the last color of the scale.
Vector2d center_of_red(const Image<Rgb>& picture) {
  Vector2d sum = Vector2d::Zero();
  double count = 0.0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const Rgb& color = picture(x, y);
      if (static_cast<int>(color[0]) < static_cast<int>(color[2]) + 60) continue;
      sum += Vector2d(x + 0.5, y + 0.5);
      count += 1.0;
    }
  }
  EXPECT_GT(count, 10.0);
  return sum / count;
}

TEST(PicturePositions, AreWhereThePictureShowsThePlace) {
  const Mesh ball = testing::sphere({5, -3, 12}, 20.0, 90);
  const RayScene scene(ball);
  for (const bool perspective : {true, false}) {
    for (const Vector3d& direction : {Vector3d(1, 0.3, 0.2), Vector3d(0.4, 1, 0.6)}) {
      const Vector3d normal = direction.normalized();
      const Vector3d place = Vector3d(5, -3, 12) + 20.0 * normal;
      RenderOptions options;
      options.width_px = 300;
      options.height_px = 240;
      options.samples_across = 1;
      options.ground = false;
      options.legend = false;
      options.perspective = perspective;
      options.color_map = ColorMap::Diverging;
      options.value_min = -1.0F;
      for (const auto& vertex : ball.vertices_mm)
        options.values.push_back((vertex.cast<double>() - place).norm() < 2.5 ? 1.0F : 0.0F);
      const auto positions =
          picture_positions(scene, options, {{place, normal}, {place - 40.0 * normal, -normal}});
      ASSERT_EQ(positions.size(), 2U);
      ASSERT_TRUE(positions[0]);
      EXPECT_LT((*positions[0] - center_of_red(render_mesh(ball, options))).norm(), 1.5);
      EXPECT_FALSE(positions[1]) << "it is on the far side";
    }
  }
}

TEST(PicturePositions, OfAHiddenPlaceAreNone) {
  Mesh mesh = testing::box({0, 0, 0}, {10, 10, 10});
  const Mesh wall = testing::box({20, -10, -10}, {22, 20, 20});
  const auto first = static_cast<std::uint32_t>(mesh.vertices_mm.size());
  mesh.vertices_mm.insert(mesh.vertices_mm.end(), wall.vertices_mm.begin(), wall.vertices_mm.end());
  for (const auto& [a, b, c] : wall.triangles)
    mesh.triangles.push_back({a + first, b + first, c + first});
  RenderOptions from_x;
  from_x.azimuth_rad = 0.0;
  from_x.elevation_rad = 0.0;
  const auto positions =
      picture_positions(RayScene(mesh), from_x, {{{10, 5, 5}, {1, 0, 0}}, {{22, 5, 5}, {1, 0, 0}}});
  EXPECT_FALSE(positions[0]);
  EXPECT_TRUE(positions[1]);
}

}  // namespace
}  // namespace frangia
