// Strips along the edges of the nominal surface, which are not judged.
#include <algorithm>
#include <cstdint>

#include <gtest/gtest.h>

#include "frangia/core/error.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/inspect/surface_verdict.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

using Eigen::Vector3d;

/// A box of 30 x 20 x 10 mm, 0.3 mm too small within 0.5 mm of its edges, with a dent amid its top.
Mesh rounded_box(double dent_mm) {
  Mesh mesh;
  constexpr int kSide = 40;
  const Eigen::Vector3d size(30, 20, 10);
  for (int axis = 0; axis < 3; ++axis)
    for (int end = 0; end < 2; ++end) {
      const auto first = static_cast<std::uint32_t>(mesh.vertices_mm.size());
      for (int i = 0; i <= kSide; ++i)
        for (int k = 0; k <= kSide; ++k) {
          Eigen::Vector3d at;
          at(axis) = end * size(axis);
          at((axis + 1) % 3) = size((axis + 1) % 3) * i / kSide;
          at((axis + 2) % 3) = size((axis + 2) % 3) * k / kSide;
          // Beyond 0.5 mm from the next edge the face is right.
          double edge = 1e9;
          for (int other = 1; other < 3; ++other) {
            const double along = at((axis + other) % 3);
            edge = std::min({edge, along, size((axis + other) % 3) - along});
          }
          double inward = edge < 0.5 ? 0.3 : 0.0;
          if (axis == 2 && end == 1 && (at.head<2>() - Eigen::Vector2d(15, 10)).norm() < 3.1)
            inward = dent_mm;
          at(axis) += end == 1 ? -inward : inward;
          mesh.vertices_mm.push_back(at.cast<float>());
        }
      for (std::uint32_t i = 0; i < kSide; ++i)
        for (std::uint32_t k = 0; k < kSide; ++k) {
          const std::uint32_t a = first + i * (kSide + 1) + k;
          const std::uint32_t b = a + kSide + 1;
          if (end == 1) {
            mesh.triangles.push_back({a, b, b + 1});
            mesh.triangles.push_back({a, b + 1, a + 1});
          } else {
            mesh.triangles.push_back({a, b + 1, b});
            mesh.triangles.push_back({a, a + 1, b + 1});
          }
        }
    }
  mesh.sigma_mm.assign(mesh.vertices_mm.size(), 0.002F);
  return mesh;
}

TEST(EdgeStrips, AreToldAndNotJudged) {
  const RayScene nominal(testing::box({0, 0, 0}, {30, 20, 10}));
  SurfaceRule rule{.limits = {-0.1, 0.1}, .min_feature_mm = 1.5, .edge_mm = 1.5};
  const auto judged = [&](double dent_mm) {
    const Mesh mesh = rounded_box(dent_mm);
    return judge_surface(mesh, deviations_of(mesh, nominal), nominal, rule);
  };
  const SurfaceVerdict good = judged(0.0);
  EXPECT_EQ(good.conformity, Conformity::In) << sentence_of(good);
  EXPECT_NE(sentence_of(good).find("strips of 1.5 mm along edges"), std::string::npos)
      << sentence_of(good);
  const double faces = 2.0 * (30 * 20 + 20 * 10 + 30 * 10);
  const double inner = 2.0 * (27 * 17 + 17 * 7 + 27 * 7);
  EXPECT_NEAR(good.area_mm2, inner, 0.02 * faces);
  EXPECT_NEAR(good.edge_share, 1.0 - inner / faces, 0.02);
  const SurfaceVerdict dented = judged(0.2);
  EXPECT_EQ(dented.conformity, Conformity::Out);
  EXPECT_NE(sentence_of(dented).find("strips of 1.5 mm"), std::string::npos) << sentence_of(dented);
  EXPECT_LT((dented.places.front().at_mm - Vector3d(15, 10, 10)).norm(), 4.0);
  rule.edge_mm = 0.0;
  EXPECT_EQ(judged(0.0).conformity, Conformity::Out) << "all is judged";
  rule.edge_mm = 40.0;
  EXPECT_THROW(static_cast<void>(judged(0.0)), Error);
}

/// A face of 20 x 10 mm that is uncertain is a gap as wide as what is judged of it: 7 mm.
TEST(EdgeStrips, DoNotWidenAGap) {
  const RayScene nominal(testing::box({0, 0, 0}, {30, 20, 10}));
  Mesh mesh = rounded_box(0.0);
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i)
    if (mesh.vertices_mm[i].x() > 29.5F) mesh.sigma_mm[i] = 0.5F;
  const SurfaceRule rule{.limits = {-0.1, 0.1}, .min_feature_mm = 1.5, .edge_mm = 1.5};
  const SurfaceVerdict verdict = judge_surface(mesh, deviations_of(mesh, nominal), nominal, rule);
  EXPECT_GT(verdict.share_of(PatchDecision::NotWellMeasured), 0.05);
  EXPECT_NEAR(verdict.gap_mm, 7.0, 2.5);
}

/// Radii below the width are edges, however finely they are tessellated; larger ones are faces.
TEST(EdgeStrips, HoldSmallRadii) {
  const auto share_of = [](float radius) {
    const Mesh mesh = testing::sphere({0, 0, 0}, radius, 60);
    const RayScene reference(mesh);
    const SurfaceRule rule{.min_feature_mm = 0.5, .edge_mm = 1.0};
    return judge_surface(mesh, deviations_of(mesh, reference), reference, rule).edge_share;
  };
  EXPECT_THROW(static_cast<void>(share_of(0.8F)), Error) << "it is one edge";
  EXPECT_EQ(share_of(1.2F), 0.0);
}

}  // namespace
}  // namespace frangia
