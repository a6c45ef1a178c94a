#include "frangia/geometry/hausdorff_distance.h"

#include <gtest/gtest.h>

#include "frangia/core/error.h"

#include "support/test_meshes.h"

namespace frangia {
namespace {

TEST(HausdorffDistance, IsTheLargerOfBothDirections) {
  const RayScene small(testing::box({0, 0, 0}, {1, 1, 1}));
  const RayScene large(testing::box({0, 0, 0}, {1, 1, 3}));
  // The top of the large box is 2 from the small one, whose top is only 0.5 from the sides.
  EXPECT_NEAR(hausdorff_distance_mm(small, large, 0.1), 2.0, 1e-9);
  EXPECT_NEAR(hausdorff_distance_mm(large, small, 0.1), 2.0, 1e-9);
}

TEST(HausdorffDistance, OfConcentricSpheresIsTheDifferenceOfTheirRadii) {
  const RayScene inner(testing::sphere({0, 0, 0}, 10.0, 60));
  const RayScene outer(testing::sphere({0, 0, 0}, 11.5, 60));
  EXPECT_NEAR(hausdorff_distance_mm(inner, outer, 0.5), 1.5, 0.02);  // facets sag by 0.004
}

TEST(HausdorffDistance, RefusesAnEmptyMeshAndASpacingOfZero) {
  const RayScene box(testing::box({0, 0, 0}, {1, 1, 1}));
  EXPECT_THROW(static_cast<void>(hausdorff_distance_mm(box, RayScene(Mesh{}), 0.1)), Error);
  EXPECT_THROW(static_cast<void>(hausdorff_distance_mm(box, box, 0.0)), Error);
}

}  // namespace
}  // namespace frangia
