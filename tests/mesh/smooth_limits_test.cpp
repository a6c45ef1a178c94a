#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "frangia/mesh/internal/smooth.h"

#include "support/error_of.h"

namespace frangia {
namespace {

/// A strip of 6 by 4 cells that is folded by 90 degrees along x = 3; vertex (x, y) is 7 y + x.
Mesh folded_strip() {
  Mesh mesh;
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 7; ++x) {
      const auto u = static_cast<float>(x);
      mesh.vertices_mm.emplace_back(
          std::min(u, 3.0F), static_cast<float>(y), std::min(0.0F, 3.0F - u));
    }
  }
  for (std::uint32_t y = 0; y < 4; ++y) {
    for (std::uint32_t x = 0; x < 6; ++x) {
      const std::uint32_t a = 7 * y + x;
      mesh.triangles.push_back({a, a + 1, a + 8});
      mesh.triangles.push_back({a, a + 8, a + 7});
    }
  }
  return mesh;
}

TEST(SmoothLimits, HoldTheBoundaryAndWhatIsNotSelected) {
  const Mesh mesh = folded_strip();
  const HalfEdges edges(mesh);
  const SmoothLimits all(mesh, edges, {});
  SmoothOptions options;
  options.only.assign(mesh.triangles.size(), 0);
  options.only[2 * (6 * 1 + 1)] = 1;  // the triangle 8, 9, 16
  const SmoothLimits some(mesh, edges, options);
  for (std::size_t v = 0; v < 35; ++v) {
    const std::size_t x = v % 7;
    const std::size_t y = v / 7;
    const bool inner = x > 0 && x < 6 && y > 0 && y < 4;
    EXPECT_EQ(all.may_move(v), inner) << v;
    EXPECT_EQ(some.may_move(v), v == 8 || v == 9 || v == 16) << v;
  }
}

TEST(SmoothLimits, AreSigmasLessAtAndBesideSharpEdges) {
  Mesh mesh = folded_strip();
  mesh.sigma_mm.assign(35, 0.1F);
  mesh.sigma_mm[8] = 0.2F;
  mesh.sigma_mm[15] = std::numeric_limits<float>::quiet_NaN();
  const HalfEdges edges(mesh);
  const SmoothLimits limits(mesh, edges, {.max_sigmas = 2.0});
  const auto most = [&](std::size_t v) {
    const Eigen::Vector3f from = mesh.vertices_mm[v];
    return (limits.allowed(v, from + Eigen::Vector3f(0.0F, 3.0F, 4.0F)) - from).norm();
  };
  EXPECT_NEAR(most(8), 0.4F, 1e-6F);
  EXPECT_NEAR(most(22), 0.2F, 1e-6F);
  EXPECT_NEAR(most(17), 0.15F * 0.2F, 1e-6F) << "on the fold";
  EXPECT_NEAR(most(16), 0.4F * 0.2F, 1e-6F) << "beside it";
  EXPECT_NEAR(most(18), 0.4F * 0.2F, 1e-6F);
  EXPECT_EQ(most(15), 0.0F) << "no sigma is known";
  // The direction stays, and what is near enough stays as wanted.
  const Eigen::Vector3f from = mesh.vertices_mm[22];
  EXPECT_LT((limits.allowed(22, from + Eigen::Vector3f(0.0F, 3.0F, 4.0F)) -
             (from + Eigen::Vector3f(0.0F, 0.12F, 0.16F)))
                .norm(),
            1e-6F);
  const Eigen::Vector3f near = from + Eigen::Vector3f(0.1F, 0.1F, 0.1F);
  EXPECT_EQ(limits.allowed(22, near), near);
  EXPECT_EQ(limits.initial_mm(), mesh.vertices_mm);
}

TEST(SmoothLimits, AreNoneWithoutSigmas) {
  Mesh mesh = folded_strip();
  const HalfEdges edges(mesh);
  const Eigen::Vector3f far(9.0F, 9.0F, 9.0F);
  EXPECT_EQ(SmoothLimits(mesh, edges, {}).allowed(8, far), far);
  mesh.sigma_mm.assign(35, 0.1F);
  EXPECT_EQ(SmoothLimits(mesh, edges, {.max_sigmas = 0.0}).allowed(8, far), far);
}

TEST(SmoothLimits, RefuseNegativeAndHugeNumbersAndASelectionOfAnotherMesh) {
  const Mesh mesh = folded_strip();
  const HalfEdges edges(mesh);
  const auto error = [&](const SmoothOptions& options) {
    return testing::error_of([&] { static_cast<void>(SmoothLimits(mesh, edges, options)); });
  };
  EXPECT_NE(error({.iterations = -1}).find("negative"), std::string::npos);
  EXPECT_NE(error({.iterations = 1'000'000'000}).find("at most 10 000"), std::string::npos);
  EXPECT_NE(error({.max_sigmas = -0.1}).find("negative"), std::string::npos);
  SmoothOptions options;
  options.only.assign(3, 1);
  EXPECT_NE(error(options).find("one selection flag per triangle"), std::string::npos);
  EXPECT_NO_THROW(static_cast<void>(SmoothLimits(mesh, edges, {.iterations = 0})));
}

}  // namespace
}  // namespace frangia
