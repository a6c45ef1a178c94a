#include <cmath>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/dataset/read_frames.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/frames/png.h"
#include "frangia/inspect/surface_error.h"
#include "frangia/reconstruct/reconstruct.h"

#include "support/error_of.h"
#include "support/small_scan.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

// Limits are about 1.3 times the value that a comment gives as measured.

using testing::error_of;
using testing::small_scan;
using testing::TemporaryFolder;

constexpr int kViews = 4;

/// The simulated rig is exact. Harmonics may look like wrong periods.
Reconstruction reconstruct_by_rig(const Scan& scan) {
  ReconstructOptions options;
  options.register_views = false;
  options.decode.accept_inconsistent = true;
  return reconstruct(scan, options);
}

SurfaceError surface_error_of(const Reconstruction& result) {
  return surface_error(result.mesh, RayScene(make_part("bracket")));
}

Scan with_reference_camera_alone(Scan scan) {
  scan.rig.cameras.resize(1);
  return scan;
}

Scan with_label(Scan scan) {
  scan.rig.projector.is_label = true;
  scan.rig.projector.position_mm.setConstant(std::nan(""));
  scan.rig.projector.rotation.setConstant(std::nan(""));
  return scan;
}

/// A scan of the bracket, rendered once for all tests.
class TwoCameras : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { static_cast<void>(scan_of_bracket()); }
  static const Scan& scan_of_bracket() {
    static const TemporaryFolder kFolder;
    static const Scan kScan = small_scan(kFolder.path(), "bracket", "binocular", kViews);
    return kScan;
  }
};

TEST_F(TwoCameras, MeasureMoreThanOneAndMoreExactly) {
  const Scan& scan = scan_of_bracket();
  const Reconstruction one = reconstruct_by_rig(with_reference_camera_alone(scan));
  const Reconstruction two = reconstruct_by_rig(scan);
  EXPECT_EQ(two.cameras, 2U);
  EXPECT_GT(two.points, one.points * 3 / 2);
  const bool has_parts = !std::isnan(two.sigma.noise_mm);
  EXPECT_LT(has_parts ? two.sigma.noise_mm : two.sigma.combined_mm, one.sigma.combined_mm);
  EXPECT_LT(surface_error_of(two).p95_mm, surface_error_of(one).p95_mm);
  ASSERT_EQ(two.agreements.size(), 1U);
  EXPECT_LT(two.agreements.front().over_noise, 1.3);
  EXPECT_GT(two.agreements.front().over_noise, 0.7);
  EXPECT_TRUE(two.agreements.front().is_consistent());
}

TEST_F(TwoCameras, ReportACameraThatHasTurned) {
  Scan scan = scan_of_bracket();
  PosedCamera& second = scan.rig.cameras.at(1);
  second.rotation =
      Eigen::AngleAxisd(rad_from_deg(0.2), Eigen::Vector3d::UnitY()) * second.rotation;
  const Reconstruction result = reconstruct_by_rig(scan);
  ASSERT_EQ(result.agreements.size(), 1U);
  EXPECT_GT(result.agreements.front().over_noise, 3.0);
  EXPECT_TRUE(result.untrusted_reason.starts_with("the cameras contradict each other"))
      << result.untrusted_reason;
  EXPECT_TRUE(std::isnan(result.sigma.combined_mm));
}

TEST_F(TwoCameras, RefuseFramesThatAreMissingOrOfAnotherSize) {
  const TemporaryFolder folder;
  Scan scan = small_scan(folder.path(), "plate", "binocular", 1, {}, 4);
  const Scan second = scan_of_camera(scan, 1);
  const std::filesystem::path frames = folder.path() / second.views.front().folder;
  const std::filesystem::path first = frames / frame_file_name(scan.patterns.front(), 0);
  const auto read = [&] { static_cast<void>(read_frames(second, 0)); };
  EXPECT_EQ(error_of(read), "");
  write_png(first, Image<std::uint8_t>(10, 8));
  EXPECT_NE(error_of(read).find("is 10 x 8 pixels, but size_px of the camera \"left\""),
            std::string::npos)
      << error_of(read);
  std::filesystem::remove(first);
  EXPECT_NE(error_of(read).find(first.filename().string()), std::string::npos) << error_of(read);
  std::filesystem::remove_all(frames);
  EXPECT_NE(error_of(read).find("there is no such folder, but rig.toml has the camera \"left\""),
            std::string::npos)
      << error_of(read);
}

TEST_F(TwoCameras, NeedAbsolutePatternsForALabel) {
  const TemporaryFolder folder;
  Scan scan = small_scan(folder.path(), "plate", "binocular", 1, {}, 4);
  scan = with_label(scan);
  scan.patterns = {scan.patterns.back()};
  EXPECT_NE(error_of([&] {
              static_cast<void>(reconstruct(scan));
            }).find("do not determine fringe orders"),
            std::string::npos);
}

}  // namespace
}  // namespace frangia
