// The two parts of sigma in the operations on vertex attributes.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/missing.h"
#include "frangia/geometry/clean_mesh.h"
#include "frangia/geometry/vertex_data.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

Mesh measured_box() {
  Mesh mesh = testing::box({0, 0, 0}, {1, 2, 3});
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i) {
    mesh.sigma_noise_mm.push_back(0.01F * static_cast<float>(i + 1));
    mesh.sigma_systematic_mm.push_back(0.2F - 0.02F * static_cast<float>(i));
  }
  combine_sigma_parts(mesh);
  return mesh;
}

void expect_consistent(const Mesh& mesh) {
  ASSERT_EQ(mesh.sigma_mm.size(), mesh.vertices_mm.size());
  ASSERT_EQ(mesh.sigma_noise_mm.size(), mesh.vertices_mm.size());
  ASSERT_EQ(mesh.sigma_systematic_mm.size(), mesh.vertices_mm.size());
  for (std::size_t i = 0; i < mesh.sigma_mm.size(); ++i) {
    EXPECT_FLOAT_EQ(mesh.sigma_mm[i],
                    std::hypot(mesh.sigma_noise_mm[i], mesh.sigma_systematic_mm[i]));
  }
}

TEST(SigmaParts, AreInterpolatedAndThenCombined) {
  Mesh mesh = measured_box();
  const std::uint32_t fresh = add_interpolated_vertex(mesh, 0, 4, 0.25F);
  EXPECT_FLOAT_EQ(mesh.sigma_noise_mm[fresh], 0.02F);
  EXPECT_FLOAT_EQ(mesh.sigma_systematic_mm[fresh], 0.18F);
  expect_consistent(mesh);
}

TEST(SigmaParts, OfASynthesizedVertexAreTheLargestAroundIt) {
  Mesh mesh = measured_box();
  const std::vector<std::uint32_t> around{1, 5};
  const std::uint32_t fresh = add_synthesized_vertex(mesh, {0, 0, 9}, around);
  EXPECT_FLOAT_EQ(mesh.sigma_noise_mm[fresh], 0.06F);
  EXPECT_FLOAT_EQ(mesh.sigma_systematic_mm[fresh], 0.18F);
  expect_consistent(mesh);
  const std::uint32_t alone = add_synthesized_vertex(mesh, {0, 0, 9}, {});
  EXPECT_TRUE(std::isnan(mesh.sigma_mm[alone]) && std::isnan(mesh.sigma_systematic_mm[alone]));
}

TEST(SigmaParts, AreKeptWithTheTrianglesThatUseThem) {
  Mesh mesh = measured_box();
  std::vector<std::uint8_t> keep(mesh.triangles.size(), 0);
  keep.back() = 1;
  const Mesh before = mesh;
  keep_triangles(mesh, keep);
  ASSERT_EQ(mesh.vertices_mm.size(), 3U);
  expect_consistent(mesh);
  std::vector<std::uint32_t> used(before.triangles.back().begin(), before.triangles.back().end());
  std::sort(used.begin(), used.end());
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(mesh.sigma_systematic_mm[i], before.sigma_systematic_mm[used[i]]);
}

TEST(SigmaParts, OfAMeshThatHasNoneCountAsNoiseWhenMeshesAreJoined) {
  Mesh noise_only = testing::box({5, 0, 0}, {6, 1, 1});
  noise_only.sigma_mm.assign(noise_only.vertices_mm.size(), 0.5F);
  for (const bool first : {true, false}) {
    Mesh joined = first ? noise_only : measured_box();
    append_mesh(joined, first ? measured_box() : noise_only);
    expect_consistent(joined);
    const std::size_t of_noise = first ? 0 : joined.vertices_mm.size() - 1;
    EXPECT_EQ(joined.sigma_noise_mm[of_noise], 0.5F);
    EXPECT_EQ(joined.sigma_systematic_mm[of_noise], 0.0F);
  }
  Mesh unmeasured = measured_box();
  append_mesh(unmeasured, testing::box({5, 0, 0}, {6, 1, 1}));
  EXPECT_EQ(unmeasured.sigma_systematic_mm.size(), unmeasured.vertices_mm.size());
  EXPECT_TRUE(std::isnan(unmeasured.sigma_systematic_mm.back()));
}

TEST(SigmaParts, AreDiscardedTogether) {
  Mesh mesh = measured_box();
  discard_sigma(mesh);
  EXPECT_TRUE(std::isnan(mesh.sigma_mm[0]) && std::isnan(mesh.sigma_noise_mm[1]) &&
              std::isnan(mesh.sigma_systematic_mm[2]));
  EXPECT_TRUE(std::isnan(median_sigma(mesh).combined_mm));
}

TEST(SigmaParts, HaveMediansOfTheirOwn) {
  const MedianSigma sigma = median_sigma(measured_box());
  EXPECT_NEAR(sigma.noise_mm, 0.045, 0.0051);
  EXPECT_NEAR(sigma.systematic_mm, 0.13, 0.011);
  Mesh noise_only = testing::box({0, 0, 0}, {1, 1, 1});
  noise_only.sigma_mm.assign(noise_only.vertices_mm.size(), 0.5F);
  EXPECT_EQ(median_sigma(noise_only).combined_mm, 0.5);
  EXPECT_TRUE(std::isnan(median_sigma(noise_only).systematic_mm));
}

TEST(SigmaParts, AreCopiedWithAVertexThatTwoFansShare) {
  Mesh mesh;  // two triangles that touch at vertex 0
  mesh.vertices_mm = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 4}};
  mesh.sigma_noise_mm = {0.3F, 0.1F, 0.1F, 0.1F, 0.1F};
  mesh.sigma_systematic_mm = {0.4F, 0.1F, 0.1F, 0.1F, 0.1F};
  combine_sigma_parts(mesh);
  split_nonmanifold_vertices(mesh);
  ASSERT_EQ(mesh.vertices_mm.size(), 6U);
  expect_consistent(mesh);
  EXPECT_EQ(mesh.sigma_systematic_mm[5], 0.4F);
}

}  // namespace
}  // namespace frangia
