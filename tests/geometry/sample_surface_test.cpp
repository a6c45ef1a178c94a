#include <gtest/gtest.h>

#include "frangia/geometry/surface_samples.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

TEST(SampleSurface, SamplesEveryFaceInProportionToItsArea) {
  const Mesh mesh = testing::box({0, 0, 0}, {10, 20, 30});
  constexpr std::size_t kCount = 22000;  // ten per square millimetre
  std::array<int, 3> on_axis{};
  for (const SurfaceSample& sample : sample_surface(mesh, kCount)) {
    Eigen::Index axis = 0;
    EXPECT_NEAR(sample.normal.cwiseAbs().maxCoeff(&axis), 1.0, 1e-12);
    ++on_axis[static_cast<std::size_t>(axis)];
  }
  EXPECT_NEAR(on_axis[0], 12000, 2);  // two faces of 20 x 30
  EXPECT_NEAR(on_axis[1], 6000, 2);
  EXPECT_NEAR(on_axis[2], 4000, 2);
}

TEST(SampleSurface, SpreadsEvenlyWithinATriangle) {
  Mesh mesh;
  mesh.vertices_mm = {{0, 0, 0}, {3, 0, 0}, {0, 3, 0}};
  mesh.triangles = {{0, 1, 2}};
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  const auto samples = sample_surface(mesh, 20000);
  for (const auto& sample : samples)
    mean += sample.point_mm / static_cast<double>(samples.size());
  EXPECT_NEAR((mean - Eigen::Vector3d(1, 1, 0)).norm(), 0.0, 0.02);
}

TEST(SampleSurface, IsTheSameForTheSameSeedOnly) {
  const Mesh mesh = testing::sphere({0, 0, 0}, 5.0, 20);
  const auto first = sample_surface(mesh, 100, 3);
  const auto again = sample_surface(mesh, 100, 3);
  const auto other = sample_surface(mesh, 100, 4);
  for (std::size_t i = 0; i < first.size(); ++i)
    EXPECT_EQ(first[i].point_mm, again[i].point_mm);
  EXPECT_NE(first[0].point_mm, other[0].point_mm);
}

TEST(SampleSurface, IsEmptyForAMeshWithoutArea) {
  EXPECT_TRUE(sample_surface(Mesh{}, 100).empty());
}

}  // namespace
}  // namespace frangia
