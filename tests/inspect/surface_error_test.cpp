#include "frangia/inspect/surface_error.h"

#include <gtest/gtest.h>

#include "frangia/core/random.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

using testing::box;
using testing::sphere;

TEST(SurfaceError, OfTheReferenceItselfIsZero) {
  const Mesh mesh = sphere({1, 2, 3}, 20.0);
  const SurfaceError error = surface_error(mesh, RayScene(mesh));
  EXPECT_EQ(error.count, mesh.vertices_mm.size());
  EXPECT_LT(error.max_mm, 1e-6);
}

TEST(SurfaceError, OfALargerSphereIsTheDifferenceOfTheRadii) {
  const SurfaceError error =
      surface_error(sphere({0, 0, 0}, 20.1, 120), RayScene(sphere({0, 0, 0}, 20.0, 120)));
  EXPECT_NEAR(error.rms_mm, 0.1, 0.004);
  EXPECT_NEAR(error.bias_mm, 0.1, 0.004);
  EXPECT_NEAR(error.max_mm, 0.1, 0.008);
}

TEST(SurfaceError, OfASmallerSphereHasANegativeBias) {
  const SurfaceError error =
      surface_error(sphere({0, 0, 0}, 19.9, 120), RayScene(sphere({0, 0, 0}, 20.0, 120)));
  EXPECT_NEAR(error.bias_mm, -0.1, 0.004);
  EXPECT_NEAR(error.mean_mm, 0.1, 0.004);
}

TEST(SurfaceError, PercentilesAreThoseOfNormalNoise) {
  Mesh noisy;
  for (std::uint64_t i = 0; i < 30000; ++i) {
    noisy.vertices_mm.emplace_back(80.0 * uniform_from(hash(1, i)) - 40.0,
                                   80.0 * uniform_from(hash(2, i)) - 40.0,
                                   10.0 + 0.05 * normal_from(hash(3, i)));
    if (i % 3 == 2) {
      const auto last = static_cast<std::uint32_t>(i);
      noisy.triangles.push_back({last - 2, last - 1, last});
    }
  }
  const SurfaceError error = surface_error(noisy, RayScene(box({-50, -50, 0}, {50, 50, 10})));
  EXPECT_NEAR(error.rms_mm, 0.05, 0.001);
  EXPECT_NEAR(error.p95_mm, 0.098, 0.002);
  EXPECT_NEAR(error.p99_mm, 0.1288, 0.004);
}

TEST(SurfaceError, IncludesOutliersAndStatesTheirShare) {
  Mesh mesh = box({-10, -10, 0}, {10, 10, 10});
  const auto first = static_cast<std::uint32_t>(mesh.vertices_mm.size());
  for (const float x : {0.0F, 1.0F})
    mesh.vertices_mm.emplace_back(x, 0.0F, 30.0F);
  mesh.vertices_mm.emplace_back(0.0F, 1.0F, 30.0F);
  mesh.triangles.push_back({first, first + 1, first + 2});
  SurfaceErrorOptions options;
  options.max_distance_mm = 1.0;
  const SurfaceError error =
      surface_error(mesh, RayScene(box({-10, -10, 0}, {10, 10, 10})), options);
  EXPECT_NEAR(error.share_beyond, 3.0 / 11.0, 1e-12);
  EXPECT_NEAR(error.rms_within_mm, 0.0, 1e-6);
  EXPECT_NEAR(error.rms_mm, 20.0 * std::sqrt(3.0 / 11.0), 1e-4);
  EXPECT_NEAR(error.max_mm, 20.0, 1e-4);
}

TEST(SurfaceError, DoesNotCountVerticesWithoutATriangle) {
  Mesh mesh = box({-10, -10, 0}, {10, 10, 10});
  mesh.vertices_mm.emplace_back(0.0F, 0.0F, 99.0F);
  const SurfaceError error = surface_error(mesh, RayScene(box({-10, -10, 0}, {10, 10, 10})));
  EXPECT_EQ(error.count, 8U);
  EXPECT_LT(error.max_mm, 1e-6);
}

TEST(SurfaceError, MeasuresSamplesInsteadOfVerticesOnRequest) {
  SurfaceErrorOptions options;
  options.samples = 5000;
  // The vertices of the coarse sphere lie on the fine one, its facets inside.
  const SurfaceError error =
      surface_error(sphere({0, 0, 0}, 20.0, 12), RayScene(sphere({0, 0, 0}, 20.0, 240)), options);
  EXPECT_EQ(error.count, 5000U);
  EXPECT_LT(error.bias_mm, -0.1);
}

TEST(SurfaceError, RefusesAnEmptyMesh) {
  const RayScene truth(box({0, 0, 0}, {1, 1, 1}));
  EXPECT_THROW(static_cast<void>(surface_error(Mesh{}, truth)), Error);
  EXPECT_THROW(static_cast<void>(surface_error(truth.mesh(), RayScene(Mesh{}))), Error);
}

TEST(VertexErrors, AreSignedAndOnePerVertex) {
  const Mesh mesh = box({-10, -10, 0}, {10, 10, 11});
  const auto errors = vertex_errors_mm(mesh, RayScene(box({-20, -20, -5}, {20, 20, 10})));
  ASSERT_EQ(errors.size(), 8U);
  EXPECT_NEAR(errors[0], -5.0F, 1e-5F);  // at z = 0, five above the bottom
  EXPECT_NEAR(errors[7], 1.0F, 1e-5F);   // at z = 11, one above the top
}

}  // namespace
}  // namespace frangia
