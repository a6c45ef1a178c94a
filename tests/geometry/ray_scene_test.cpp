#include "frangia/geometry/ray_scene.h"

#include <algorithm>
#include <array>
#include <limits>
#include <stop_token>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/core/random.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

using Eigen::Vector3d;
using testing::box;
using testing::sphere;

RayScene unit_cube() {
  return RayScene(box({-1, -1, -1}, {1, 1, 1}));
}

TEST(RayScene, HitsAPlaneExactlyFromFarAway) {
  const RayScene scene = unit_cube();
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const Vector3d eye(700.0, 80.0 * uniform_from(hash(1, i)), 90.0 * uniform_from(hash(2, i)));
    const Vector3d target(
        1.0, 1.8 * uniform_from(hash(3, i)) - 0.9, 1.8 * uniform_from(hash(4, i)) - 0.9);
    const auto hit = scene.first_hit(eye, (target - eye) / 3.0);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance, 3.0, 1e-12);
    EXPECT_NEAR(hit->normal.x(), 1.0, 1e-12);
  }
}

TEST(RayScene, BarycentricWeightsReproduceTheHitPoint) {
  const Mesh mesh = sphere({1, 2, 3}, 20.0);
  const RayScene scene(mesh);
  const Vector3d eye(90, -70, 50);
  const Vector3d direction = Vector3d(2.3, 1.1, 4.0) - eye;
  const auto hit = scene.first_hit(eye, direction);
  ASSERT_TRUE(hit);
  Vector3d rebuilt = Vector3d::Zero();
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const auto vertex = mesh.triangles[hit->triangle][corner];
    rebuilt += hit->barycentric[static_cast<Eigen::Index>(corner)] *
               mesh.vertices_mm[vertex].cast<double>();
  }
  EXPECT_NEAR((rebuilt - eye - hit->distance * direction).norm(), 0.0, 1e-9);
  EXPECT_GT(hit->barycentric.minCoeff(), -1e-4);
}

TEST(RayScene, HitsNothingBesideBehindOrBeyondTheLargestDistance) {
  const RayScene scene = unit_cube();
  EXPECT_FALSE(scene.first_hit({5, 1.01, 0}, {-1, 0, 0}));
  EXPECT_FALSE(scene.first_hit({5, 0, 0}, {1, 0, 0}));
  EXPECT_FALSE(scene.first_hit({5, 0, 0}, {-1, 0, 0}, 3.9));
  EXPECT_TRUE(scene.first_hit({5, 0, 0}, {-1, 0, 0}, 4.1));
  EXPECT_FALSE(RayScene(Mesh{}).first_hit({0, 0, 0}, {1, 0, 0}));
  EXPECT_FALSE(RayScene(Mesh{}).nearest({0, 0, 0}));
}

TEST(RayScene, OccludedMeansSomethingBetweenTheTwoPoints) {
  const RayScene scene = unit_cube();
  EXPECT_TRUE(scene.occluded({5, 0, 0}, {-5, 0, 0}));
  EXPECT_FALSE(scene.occluded({5, 0, 0}, {2, 0, 0}));
  EXPECT_FALSE(scene.occluded({5, 2, 0}, {-5, 2, 0}));
}

TEST(RayScene, NearestIsThatOfASearchThroughAllTriangles) {
  const Vector3d center(1, 2, 3);
  const RayScene scene(sphere(center, 20.0, 60));
  for (std::uint64_t i = 0; i < 500; ++i) {
    const Vector3d p =
        center +
        30.0 * Vector3d(normal_from(hash(1, i)), normal_from(hash(2, i)), normal_from(hash(3, i)));
    const auto nearest = scene.nearest(p);
    ASSERT_TRUE(nearest);
    const double expected = (p - center).norm() - 20.0;
    // The facets lie up to 0.014 mm inside the sphere.
    EXPECT_NEAR(nearest->signed_distance_mm, expected, 0.02);
    EXPECT_NEAR((nearest->point_mm - p).norm(), nearest->distance_mm, 1e-12);
  }
}

TEST(RayScene, NearestDistinguishesInsideFromOutsideAtEdgesAndCorners) {
  const RayScene scene = unit_cube();
  EXPECT_NEAR(scene.nearest({2, 2, 2})->signed_distance_mm, std::sqrt(3.0), 1e-9);
  EXPECT_NEAR(scene.nearest({1.3, 1.4, 0.2})->signed_distance_mm, 0.5, 1e-7);
  EXPECT_NEAR(scene.nearest({0.9, 0.95, 0.2})->signed_distance_mm, -0.05, 1e-7);
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const Vector3d p(3.0 * uniform_from(hash(1, i)) - 1.5,
                     3.0 * uniform_from(hash(2, i)) - 1.5,
                     3.0 * uniform_from(hash(3, i)) - 1.5);
    const bool inside = p.cwiseAbs().maxCoeff() < 1.0;
    EXPECT_EQ(scene.nearest(p)->signed_distance_mm < 0.0, inside) << p.transpose();
  }
}

TEST(RayScene, NearestStopsAtTheLargestDistance) {
  const RayScene scene = unit_cube();
  EXPECT_FALSE(scene.nearest({3, 0, 0}, 1.999));
  EXPECT_TRUE(scene.nearest({3, 0, 0}, 2.001));
}

TEST(RayScene, IgnoresTrianglesWithoutArea) {
  Mesh mesh = box({-1, -1, -1}, {1, 1, 1});
  mesh.vertices_mm.emplace_back(0, 0, 9);
  mesh.triangles.push_back({8, 8, 8});
  const auto nearest = RayScene(mesh).nearest({0, 0, 10});
  ASSERT_TRUE(nearest);
  EXPECT_NEAR(nearest->distance_mm, 9.0, 1e-9);
}

TEST(RayScene, RefusesATriangleOfAVertexThatDoesNotExist) {
  Mesh mesh = box({-1, -1, -1}, {1, 1, 1});
  mesh.triangles.push_back({0, 1, 8});
  EXPECT_THROW(RayScene{mesh}, Error);
}

TEST(RayScene, GivesAScaledAnswerForAScaledMesh) {
  // Near an edge of a tiny box, two triangles are less than a micrometre apart.
  for (const float scale : {1.0F, 1.0F / 1024.0F, 1024.0F}) {
    const RayScene scene(box({-scale, -scale, -scale}, {scale, scale, scale}));
    const double s = static_cast<double>(scale);
    for (std::uint64_t i = 0; i < 200; ++i) {
      const Vector3d p(2.0 * uniform_from(hash(1, i)), 1.0 + 1e-5 * uniform_from(hash(2, i)), 0.3);
      const auto one = unit_cube().nearest(p);
      const auto scaled = scene.nearest(s * p);
      ASSERT_TRUE(one && scaled);
      EXPECT_EQ(scaled->triangle, one->triangle);
      EXPECT_NEAR(scaled->signed_distance_mm / s, one->signed_distance_mm, 1e-12);
    }
  }
}

/// A quad cut into two triangles, `copies` times, of corners in other orders and vertices of their
/// own.
Mesh repeated_quad(std::uint32_t copies) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < copies; ++i) {
    const std::uint32_t v = 4 * i;
    for (const Eigen::Vector3f& corner :
         {Eigen::Vector3f(0, 0, 0), {1, 0, 0}, {1, 1, 0}, {0, 1, 0}})
      mesh.vertices_mm.push_back(corner);
    const std::uint32_t turn = i % 3;
    std::array<std::uint32_t, 3> lower{v, v + 1, v + 2};
    std::rotate(lower.begin(), lower.begin() + turn, lower.end());
    mesh.triangles.push_back(lower);
    mesh.triangles.push_back({v, v + 2, v + 3});
  }
  return mesh;
}

TEST(RayScene, NamesTheFirstOfRepeatedTriangles) {
  Mesh mesh = box({-1, -1, 5}, {1, 1, 6});
  const auto first = static_cast<std::uint32_t>(mesh.triangles.size());
  const Mesh quads = repeated_quad(50);
  for (const auto& [a, b, c] : quads.triangles)
    mesh.triangles.push_back({a + 8, b + 8, c + 8});
  mesh.vertices_mm.insert(
      mesh.vertices_mm.end(), quads.vertices_mm.begin(), quads.vertices_mm.end());
  mesh.triangles.push_back({0, 1, 2});  // beyond the repeated ones
  const RayScene scene(mesh);
  const auto nearest = scene.nearest({0.7, 0.2, 0.5});
  ASSERT_TRUE(nearest);
  EXPECT_EQ(nearest->triangle, first);
  const auto hit = scene.first_hit({0.2, 0.7, -1.0}, {0, 0, 1});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->triangle, first + 1);
}

TEST(RayScene, IsAsFastWithRepeatedTriangles) {
  // Without their removal each query visits all of them: a minute.
  const RayScene scene(repeated_quad(50'000));
  double sum = 0.0;
  for (std::uint64_t i = 0; i < 100'000; ++i)
    sum += scene.nearest({uniform_from(hash(1, i)), uniform_from(hash(2, i)), 0.5})->distance_mm;
  EXPECT_NEAR(sum, 50'000.0, 1e-6);
}

TEST(RayScene, HitsNothingByRaysBeyondSinglePrecision) {
  const RayScene scene = unit_cube();
  for (const double far : {1e19, 1e300, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(scene.first_hit({far, 0, 0}, {-1, 0, 0}));
    EXPECT_FALSE(scene.first_hit({5, 0, 0}, {-far, 0, 0}));
    EXPECT_FALSE(scene.occluded({far, 0, 0}, {0, 0, 0}));
  }
}

TEST(RayScene, StopsWhenItsTaskIsCancelled) {
  std::stop_source stop;
  stop.request_stop();
  const frangia::Run run{.stop = stop.get_token()};
  EXPECT_THROW(RayScene(unit_cube().mesh(), run), Error);
}

}  // namespace
}  // namespace frangia
