// The covariance of the calibration from rig.toml to the mesh.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "frangia/dataset/scan_folder.h"
#include "frangia/reconstruct/reconstruct.h"
#include "frangia/rig/write_rig.h"

#include "support/small_scan.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

TEST(SystematicPart, OfTheCalibrationStandsBesideTheNoiseOfTheMesh) {
  const testing::TemporaryFolder folder;
  // Of one view, whose place nothing else can contradict.
  Scan exact = testing::small_scan(
      folder.path() / "scan", "bracket", "digital", 1, {.samples_per_px = 4}, 4);
  exact.rig.turntable->point_sigma_mm = 0.0;
  exact.rig.turntable->axis_sigma_rad = 0.0;
  exact.rig.turntable->angle_sigma_rad = 0.0;
  const Reconstruction before = reconstruct(exact, {.keep_raw = true});
  EXPECT_TRUE(before.mesh.sigma_systematic_mm.empty());
  EXPECT_TRUE(before.raw.systematic_mm.empty());
  EXPECT_FALSE(std::isnan(before.sigma.combined_mm));
  EXPECT_TRUE(std::isnan(before.sigma.systematic_mm));

  Rig rig = exact.rig;
  rig.calibration = Calibration{.covariance_file = "rig-covariance.csv",
                                .covariance = {{"camera.k1", "projector.focal_px"},
                                               Eigen::Matrix2d{{4e-6, 1e-4}, {1e-4, 4.0}}}};
  write_rig(folder.path() / "scan/rig.toml", rig);
  const Scan scan = read_scan(folder.path() / "scan");
  const Reconstruction after = reconstruct(scan, {.keep_raw = true});
  EXPECT_EQ(after.mesh.vertices_mm, before.mesh.vertices_mm);
  EXPECT_EQ(after.mesh.triangles, before.mesh.triangles);
  EXPECT_EQ(after.mesh.sigma_noise_mm, before.mesh.sigma_mm);
  ASSERT_EQ(after.mesh.sigma_systematic_mm.size(), after.mesh.vertices_mm.size());
  EXPECT_TRUE(std::all_of(after.mesh.sigma_systematic_mm.begin(),
                          after.mesh.sigma_systematic_mm.end(),
                          [](float sigma) { return sigma >= 0.0F && sigma < 1.0F; }));
  EXPECT_GT(after.sigma.systematic_mm, 0.001);
  EXPECT_GT(after.sigma.combined_mm, before.sigma.combined_mm);
  EXPECT_EQ(after.raw.systematic_mm.size(), after.raw.points_mm.size());
  EXPECT_EQ(after.raw.sigma_mm.size(), before.raw.sigma_mm.size());
  EXPECT_EQ(after.raw.points_mm, before.raw.points_mm);
}

// Pixels at edges mix two surfaces, which the views of a sound scan have in common, and some rig
// far off explains it.
TEST(SystematicPart, CountsNoRigWhoseEffectOnTheViewsIsNotNoticeable) {
  const testing::TemporaryFolder folder;
  const Scan scan =
      testing::small_scan(folder.path() / "scan", "shaft", "angular", 8, {.samples_per_px = 4}, 2);
  const Reconstruction result = reconstruct(scan, {});
  EXPECT_LT(result.sigma.systematic_mm, result.sigma.noise_mm);
}

}  // namespace
}  // namespace frangia
