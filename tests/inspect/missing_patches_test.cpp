// Material that is missing: what views have looked through.
#include "frangia/inspect/internal/missing_patches.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "frangia/inspect/surface_verdict.h"

#include "support/measured_plate.h"
#include "support/test_meshes.h"

namespace frangia {
namespace {

using Eigen::Vector3f;

using testing::distance_from;
using testing::kSigma;

/// A plate of 20 x 20 x 5 mm with a round pin in its middle, 12 mm high: a solid.
Mesh plate_with_pin(float radius_mm) {
  Mesh nominal = testing::level_grid(81, 81);
  for (Vector3f& vertex : nominal.vertices_mm) {
    vertex *= 0.25F;
    vertex.z() = distance_from(vertex, 10, 10) < radius_mm ? 17.0F : 5.0F;
  }
  testing::add_floor(nominal);
  return nominal;
}

/// The top of the plate without the pin, one vertex each half millimetre.
Mesh top_without_pin() {
  Mesh measured = testing::level_grid(41, 41);
  for (Vector3f& vertex : measured.vertices_mm) {
    vertex *= 0.5F;
    vertex.z() = 5.0F;
  }
  measured.sigma_mm.assign(measured.vertices_mm.size(), kSigma);
  return measured;
}

SurfaceVerdict verdict_without_pin(float radius_mm, const Mesh& measured) {
  const RayScene reference(plate_with_pin(radius_mm));
  return judge_surface(
      measured, deviations_of(measured, reference), reference, {.limits = {-0.1, 0.1}});
}

/// Whatever view saw the root has looked through the place of the pin, however high that is.
TEST(MissingPatches, OfAPinAreOutWhereItsRootWasMeasured) {
  for (const float radius_mm : {3.0F, 2.0F, 1.5F}) {
    const SurfaceVerdict verdict = verdict_without_pin(radius_mm, top_without_pin());
    EXPECT_EQ(verdict.conformity, Conformity::Out) << radius_mm;
    ASSERT_FALSE(verdict.places.empty());
    EXPECT_TRUE(verdict.places.front().missing);
    EXPECT_GT(verdict.places.front().at_mm.z(), 6.0);
    EXPECT_LT(distance_from(verdict.places.front().at_mm.cast<float>(), 10, 10), radius_mm + 0.3F);
    EXPECT_NE(sentence_of(verdict).find("missing"), std::string::npos) << sentence_of(verdict);
  }
}

TEST(MissingPatches, AreNotThoseOfAPinWhoseRootIsNotMeasured) {
  const auto is_open = [](const SurfaceVerdict& verdict) {
    EXPECT_EQ(verdict.conformity, Conformity::Undecided);
    EXPECT_TRUE(std::none_of(verdict.places.begin(),
                             verdict.places.end(),
                             [](const SurfacePlace& place) { return place.missing; }));
  };
  // A pin that no view measured, because it is black: it hides its root.
  Mesh around = top_without_pin();
  const auto is_root = [&](const Mesh::Triangle& triangle) {
    return std::all_of(triangle.begin(), triangle.end(), [&](std::uint32_t v) {
      return distance_from(around.vertices_mm[v], 10, 10) < 2.2F;
    });
  };
  Mesh closed = around;
  closed.triangle_marks.assign(closed.triangles.size(), Mark::Measured);
  for (std::size_t i = 0; i < closed.triangles.size(); ++i)
    if (is_root(closed.triangles[i])) closed.triangle_marks[i] = Mark::Synthesized;
  std::erase_if(around.triangles, is_root);
  is_open(verdict_without_pin(2.0F, around));
  is_open(verdict_without_pin(2.0F, closed));
  // A root of a few points may be a bridge between them.
  is_open(verdict_without_pin(0.6F, top_without_pin()));
}

}  // namespace
}  // namespace frangia
