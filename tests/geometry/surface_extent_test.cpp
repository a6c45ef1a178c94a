#include "frangia/geometry/surface_extent.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/error_of.h"
#include "support/test_meshes.h"

namespace frangia {
namespace {

using std::numbers::pi;

/// Noise n and a systematic part s at every vertex.
Mesh with_sigma(Mesh mesh, float noise_mm, float systematic_mm) {
  const std::size_t count = mesh.vertices_mm.size();
  mesh.sigma_mm.assign(count, std::hypot(noise_mm, systematic_mm));
  mesh.sigma_noise_mm.assign(count, noise_mm);
  mesh.sigma_systematic_mm.assign(count, systematic_mm);
  return mesh;
}

TEST(SurfaceExtent, MeasuresABall) {
  const Mesh ball = testing::sphere({500, 20, -3}, 10.0);
  EXPECT_NEAR(area_of(ball).value, 4.0 * pi * 100.0, 2.0);
  EXPECT_NEAR(volume_of(ball).value, 4.0 / 3.0 * pi * 1000.0, 6.0);
  EXPECT_TRUE(std::isnan(area_of(ball).u));
  EXPECT_TRUE(std::isnan(volume_of(ball).u));
}

TEST(SurfaceExtent, MeasuresTheSelectionOrAll) {
  const Mesh box = testing::box({0, 0, 0}, {2, 3, 4});
  EXPECT_NEAR(area_of(box).value, 52.0, 1e-9);
  EXPECT_NEAR(volume_of(box).value, 24.0, 1e-9);
  Selection top(box.triangles.size());
  for (std::size_t t = 0; t < top.size(); ++t) {
    const auto high = [&](std::uint32_t vertex) { return box.vertices_mm[vertex].z() > 3.0F; };
    const auto& [a, b, c] = box.triangles[t];
    top[t] = high(a) && high(b) && high(c) ? 1 : 0;
  }
  EXPECT_NEAR(area_of(box, top).value, 6.0, 1e-9);
  EXPECT_NEAR(area_of(box, Selection(box.triangles.size())).value, 52.0, 1e-9);
}

TEST(SurfaceExtent, AnErrorThatIsAlikeMovesAllOfABall) {
  const double s = 0.01;
  const Mesh ball = with_sigma(testing::sphere({0, 0, 0}, 10.0), 0.0F, static_cast<float>(s));
  // dV = 4 pi r^2 s and dA = 8 pi r s.
  EXPECT_NEAR(volume_of(ball).u, 4.0 * pi * 100.0 * s, 0.01 * 4.0 * pi * 100.0 * s);
  EXPECT_NEAR(area_of(ball).u, 8.0 * pi * 10.0 * s, 0.02 * 8.0 * pi * 10.0 * s);
}

TEST(SurfaceExtent, NoiseAveragesOut) {
  const Mesh coarse = with_sigma(testing::sphere({0, 0, 0}, 10.0, 20), 0.01F, 0.0F);
  const Mesh fine = with_sigma(testing::sphere({0, 0, 0}, 10.0, 80), 0.01F, 0.0F);
  // Four times as many rings, sixteen times as many vertices.
  EXPECT_NEAR(volume_of(coarse).u / volume_of(fine).u, 4.0, 0.4);
  EXPECT_GT(volume_of(fine).u, 0.0);
}

TEST(SurfaceExtent, AnOpenSurfaceHasNoVolume) {
  Mesh box = testing::box({0, 0, 0}, {2, 3, 4});
  box.triangles.pop_back();
  EXPECT_NE(testing::error_of([&] { static_cast<void>(volume_of(box)); }).find("has a hole"),
            std::string::npos);
  EXPECT_LT(area_of(box).value, 52.0);
}

}  // namespace
}  // namespace frangia
