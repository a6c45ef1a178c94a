// Means over patches of the nominal surface, and their uncertainty.
#include "frangia/inspect/surface_patches.h"

#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "frangia/core/random.h"
#include "frangia/geometry/ray_scene.h"

#include "support/measured_plate.h"
#include "support/test_meshes.h"

namespace frangia {
namespace {

using Eigen::Vector3f;
using testing::Plate;

TEST(SurfacePatches, AveragesNoiseAndKeepsTheSystematicPart) {
  Plate plate;
  plate.add_noise(5, 0.02);
  Mesh& mesh = plate.mesh();
  mesh.sigma_noise_mm.assign(mesh.vertices_mm.size(), 0.02F);
  mesh.sigma_systematic_mm.assign(mesh.vertices_mm.size(), 0.005F);
  mesh.sigma_mm.assign(mesh.vertices_mm.size(), std::hypot(0.02F, 0.005F));
  const RayScene reference(testing::level_grid(61, 61));
  const Deviations found = deviations_of(mesh, reference);
  const SurfacePatches patches = surface_patches(mesh, found, reference, 8.0);
  EXPECT_LT(patches.noise_factor, 1.5);
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const Vector3f& at = patches.center_mm[i];
    if (at.head<2>().minCoeff() < 5.0F || at.head<2>().maxCoeff() > 55.0F) continue;
    // A circle of 8 mm holds 50 vertices.
    EXPECT_NEAR(
        patches.noise_mm[i] / std::sqrt(patches.noise_factor), 0.02 / std::sqrt(50.3), 4e-4);
    EXPECT_NEAR(patches.systematic_mm[i], 0.005, 1e-6);
  }
  std::size_t within = 0;
  for (const float deviation : patches.deviation_mm)
    within += std::abs(deviation) < 2.5F * 0.02F / 7.0F ? 1U : 0U;
  EXPECT_GT(within, patches.size() * 95 / 100);
}

TEST(SurfacePatches, AreMeasuredWhereverAVertexLies) {
  // Patches of slightly less than two distances of the vertices: some hold a single one.
  constexpr int kSize = 201;
  const Mesh mesh = testing::level_grid(kSize, kSize);
  const RayScene reference(testing::level_grid(kSize, kSize));
  const SurfacePatches patches =
      surface_patches(mesh, deviations_of(mesh, reference), reference, 1.8);
  std::size_t inner = 0;
  std::size_t unmeasured = 0;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const Vector3f& at = patches.center_mm[i];
    if (at.head<2>().minCoeff() < 3.0F || at.head<2>().maxCoeff() > kSize - 4.0F) continue;
    ++inner;
    unmeasured += patches.is_measured(i) ? 0U : 1U;
  }
  EXPECT_GT(inner, 10'000U);
  EXPECT_EQ(unmeasured, 0U);
}

TEST(SurfacePatches, CountsNoiseThatNeighborsShare) {
  Plate plate;
  // All vertices of squares of 3 x 3 err alike: a mean of nine is no better than one vertex.
  plate.raise([](const Vector3f& at) {
    const auto column = static_cast<std::uint64_t>(at.x()) / 3U;
    const auto row = static_cast<std::uint64_t>(at.y()) / 3U;
    return 0.01 * normal_from(hash(7U + column, row));
  });
  plate.mesh().sigma_mm.assign(plate.mesh().vertices_mm.size(), 0.01F);
  const RayScene reference(testing::level_grid(61, 61));
  const SurfacePatches patches =
      surface_patches(plate.mesh(), deviations_of(plate.mesh(), reference), reference, 6.0);
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const Vector3f& at = patches.center_mm[i];
    if (at.head<2>().minCoeff() < 4.0F || at.head<2>().maxCoeff() > 56.0F) continue;
    // Of 28 vertices about 4 are independent.
    EXPECT_GT(patches.noise_mm[i], 0.01F / std::sqrt(28.0F) * 2.0F);
    EXPECT_LT(patches.noise_mm[i], 0.01F);
  }
}

/// Vertices that fusion samples share pixels: errors are alike by 2/3 at a spacing and by 1/3 at
/// two.
TEST(SurfacePatches, StatesTheSpreadOfPatchesWhoseVerticesShareErrors) {
  Plate plate;
  plate.raise([](const Vector3f& at) {
    double sum = 0.0;
    for (std::uint64_t i = 0; i < 3; ++i)
      for (std::uint64_t k = 0; k < 3; ++k)
        sum += normal_from(hash(static_cast<std::uint64_t>(at.x() + 0.5F) + i,
                                static_cast<std::uint64_t>(at.y() + 0.5F) + k));
    return 0.01 * sum / 3.0;
  });
  plate.mesh().sigma_mm.assign(plate.mesh().vertices_mm.size(), 0.01F);
  const RayScene reference(testing::level_grid(61, 61));
  const SurfacePatches patches =
      surface_patches(plate.mesh(), deviations_of(plate.mesh(), reference), reference, 2.0);
  double squares = 0.0;
  std::size_t measured = 0;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (!patches.is_measured(i)) continue;
    squares += std::pow(static_cast<double>(patches.deviation_mm[i]) / patches.u_mm(i), 2);
    ++measured;
  }
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(measured)), 1.0, 0.12);
}

}  // namespace
}  // namespace frangia
