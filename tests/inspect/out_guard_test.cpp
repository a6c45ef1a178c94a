// The guard bands of "out" for many patches together.
#include "frangia/inspect/internal/out_guard.h"

#include <gtest/gtest.h>

namespace frangia::inspect {
namespace {

/// A square of patches 1 mm apart, of 2 mm, with an uncertainty each.
SurfacePatches square(int side, float noise_mm, float systematic_mm) {
  SurfacePatches patches;
  patches.diameter_mm = 2.0;
  for (int i = 0; i < side * side; ++i) {
    patches.center_mm.emplace_back(static_cast<float>(i % side), static_cast<float>(i / side), 0);
    patches.area_mm2.push_back(1.0);
    patches.at_edge.push_back(0);
    patches.deviation_mm.push_back(0.0F);
    patches.noise_mm.push_back(noise_mm);
    patches.systematic_mm.push_back(systematic_mm);
  }
  return patches;
}

TEST(OutGuard, GrowsWithTheNumberOfPatchesThatFitBesideEachOther) {
  const OutGuard one = out_guard_of(square(1, 0.01F, 0.0F));
  EXPECT_EQ(one.independent, 1U);
  EXPECT_NEAR(one.guard_mm(0.01, 0.0), 0.0164, 1e-4);
  const OutGuard many = out_guard_of(square(30, 0.01F, 0.0F));
  EXPECT_NEAR(static_cast<double>(many.independent), 900.0 / 3.14159, 1.0);
  EXPECT_NEAR(many.guard_mm(0.01, 0.0), 0.0358, 3e-4);  // 5 % over 287: 3.58 u
}

/// A systematic error is the same over a third of the part, so its independent samples are regions,
/// not patches.
TEST(OutGuard, CountsRegionsForTheSystematicPart) {
  const OutGuard guard = out_guard_of(square(30, 0.001F, 0.01F));
  EXPECT_TRUE(guard.split);
  EXPECT_LT(guard.guard_mm(0.0, 0.01), guard_band_of_many(guard.independent) * 0.01);
  EXPECT_GT(guard.guard_mm(0.0, 0.01), guard_band_of_many(9) * 0.01);
}

TEST(OutGuard, OfNothingMeasuredIsThatOfOneValue) {
  SurfacePatches none = square(3, 0.01F, 0.0F);
  none.deviation_mm.assign(9, std::nanf(""));
  EXPECT_EQ(out_guard_of(none).independent, 1U);
}

}  // namespace
}  // namespace frangia::inspect
