#include "frangia/inspect/surface_validity.h"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "frangia/simulate/parts.h"

namespace frangia {
namespace {

TEST(SurfaceValidity, FindsNoDefectInTheReferenceItself) {
  const Mesh truth = make_part("bracket");
  const SurfaceValidity found = surface_validity(truth, RayScene(truth));
  EXPECT_EQ(found.non_manifold_edges, 0U);
  EXPECT_EQ(found.inward_triangles, 0U);
  EXPECT_TRUE(std::isnan(found.sigma_ratio));
}

TEST(SurfaceValidity, CountsReversedTriangles) {
  const Mesh truth = make_part("bracket");
  Mesh turned = truth;
  for (const std::size_t i : {std::size_t{5}, turned.triangles.size() / 2})
    std::swap(turned.triangles[i][0], turned.triangles[i][1]);
  const SurfaceValidity found = surface_validity(turned, RayScene(truth));
  EXPECT_EQ(found.inward_triangles, 2U);
  EXPECT_GE(found.non_manifold_edges, 4U);
}

TEST(SurfaceValidity, ComparesErrorsWithSigma) {
  const Mesh truth = make_part("plate");
  Mesh off = truth;
  for (auto& vertex : off.vertices_mm)
    vertex.z() += 100.0F;  // 100 mm above the reference
  off.sigma_mm.assign(off.vertices_mm.size(), 1e6F);
  EXPECT_LT(surface_validity(off, RayScene(truth)).sigma_ratio, 1e-3);
}

}  // namespace
}  // namespace frangia
