// The truth is the rig with two cameras through which the poses are rendered.
#include <cmath>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "frangia/calibrate/report/calibration_report.h"
#include "frangia/calibrate/solve/calibrate_rig.h"
#include "frangia/core/image.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/frames/png.h"
#include "frangia/rig/read_rig.h"
#include "frangia/rig/write_rig.h"
#include "frangia/simulate/simulate_calibration.h"

#include "support/error_of.h"
#include "support/small_scan.h"
#include "support/temporary_folder.h"
#include "support/text_of.h"

namespace frangia {
namespace {

/// Six poses of a checkerboard, rendered once for all tests.
class CalibrateCameras : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new testing::TemporaryFolder;  // NOLINT(*-owning-memory) deleted below
    CalibrationPlan plan;
    plan.folder = poses();
    plan.rig = testing::small_rig("binocular", 3);
    plan.poses = 6;
    static_cast<void>(simulate_calibration(plan, {.samples_per_px = 4}));
  }
  static void TearDownTestSuite() {
    delete folder_;  // NOLINT(*-owning-memory)
    delete found_;   // NOLINT(*-owning-memory)
  }

  [[nodiscard]] static std::filesystem::path poses() { return folder_->path() / "poses"; }
  [[nodiscard]] static Scan scan() { return read_scan(poses(), {}, RigContent::StartValues); }
  /// What the poses give, with the pictures for a report, calibrated once.
  [[nodiscard]] static const RigCalibration& found() {
    if (found_ == nullptr) {
      CalibrateRigOptions options;
      options.pose.keep_picture = true;
      found_ = new RigCalibration(calibrate_rig(scan(), options));  // NOLINT(*-owning-memory)
    }
    return *found_;
  }
  [[nodiscard]] static PosedCamera true_camera() {
    return read_rig(poses() / "truth-rig.toml").cameras.at(1);
  }

 private:
  static testing::TemporaryFolder* folder_;
  static RigCalibration* found_;
};

testing::TemporaryFolder* CalibrateCameras::folder_ = nullptr;
RigCalibration* CalibrateCameras::found_ = nullptr;

/// Expects the second camera within three standard deviations.
void expect_near_truth(const RigCalibration& found, const PosedCamera& truth) {
  const PosedCamera& camera = found.rig.cameras.at(1);
  const auto sigma = [&](const std::string& name) {
    for (const auto& [parameter, value] : found.rig.calibration->sigma)
      if (parameter == "camera-left." + name) return value;
    ADD_FAILURE() << name << " has no standard deviation";
    return 0.0;
  };
  const auto expect = [&](const std::string& name, double value, double expected) {
    EXPECT_NEAR(value, expected, 3.0 * sigma(name)) << name;
  };
  expect("focal_px", camera.camera.model.focal_px.x(), truth.camera.model.focal_px.x());
  expect("principal_x_px",
         camera.camera.model.principal_point_px.x(),
         truth.camera.model.principal_point_px.x());
  expect("principal_y_px",
         camera.camera.model.principal_point_px.y(),
         truth.camera.model.principal_point_px.y());
  const Eigen::Vector3d shift = camera.camera_from_rig().translation();
  const Eigen::Vector3d true_shift = truth.camera_from_rig().translation();
  expect("x_mm", shift.x(), true_shift.x());
  expect("y_mm", shift.y(), true_shift.y());
  expect("z_mm", shift.z(), true_shift.z());
  const auto turn_of = [](const Eigen::Matrix3d& rotation) {
    const Eigen::AngleAxisd turn(rotation);
    return Eigen::Vector3d(turn.angle() * turn.axis());
  };
  const Eigen::Vector3d turn = turn_of(camera.rotation);
  const Eigen::Vector3d true_turn = turn_of(truth.rotation);
  expect("rotation_x_rad", turn.x(), true_turn.x());
  expect("rotation_y_rad", turn.y(), true_turn.y());
  expect("rotation_z_rad", turn.z(), true_turn.z());
  EXPECT_LT(sigma("x_mm"), 1.0);
  EXPECT_LT(sigma("focal_px"), 0.01 * truth.camera.model.focal_px.x());
}

TEST_F(CalibrateCameras, FindTheSecondCameraWithinItsStandardDeviations) {
  const RigCalibration& found = CalibrateCameras::found();
  EXPECT_EQ(found.views.size(), 6U);
  expect_near_truth(found, true_camera());
  const testing::TemporaryFolder folder;
  Rig rig = found.rig;
  rig.calibration->covariance_file = "covariance.csv";
  rig.calibration->covariance = {found.solution.parameters, found.solution.covariance};
  write_rig(folder.path() / "rig.toml", rig);
  const Rig read = read_rig(folder.path() / "rig.toml");
  EXPECT_EQ(read.calibration->covariance.parameters.back(), "camera-left.z_mm");
  EXPECT_NEAR(read.cameras[1].position_mm.x(), rig.cameras[1].position_mm.x(), 1e-6);
}

TEST_F(CalibrateCameras, FindEachOtherByAProjectorThatLabelsPoints) {
  Scan label = scan();
  label.rig.projector.is_label = true;
  const RigCalibration found = calibrate_rig(label);
  expect_near_truth(found, true_camera());
  EXPECT_TRUE(found.rig.projector.is_label);
  EXPECT_EQ(found.solution.parameters.size(), 24U);
  EXPECT_GT(found.solution.point_sigma_mm, 0.0);
  EXPECT_LT(found.solution.cameras[1].projector_residuals.rms_px, 0.2);
}

TEST_F(CalibrateCameras, AreInTheReport) {
  const RigCalibration& found = CalibrateCameras::found();
  const testing::TemporaryFolder folder;
  write_calibration_report(folder.path() / "report.html", found, *scan().board);
  const std::string html = testing::text_of(folder.path() / "report.html");
  EXPECT_NE(html.find("camera &quot;left&quot;: residuals of all points"), std::string::npos);
}

TEST_F(CalibrateCameras, AreNamedByTheDoctor) {
  const testing::TemporaryFolder folder;
  const std::filesystem::path copy = folder.path() / "poses";
  std::filesystem::copy(poses(), copy, std::filesystem::copy_options::recursive);
  for (const auto& file : std::filesystem::recursive_directory_iterator(copy)) {
    const bool left = file.path().parent_path().filename() == "left";
    if (left && file.path().extension() == ".png")
      write_png(file.path(), Frame(Image<std::uint8_t>(320, 256, 3)));
  }
  const std::string fault = testing::error_of(
      [&] { static_cast<void>(calibrate_rig(read_scan(copy, {}, RigContent::StartValues))); });
  EXPECT_EQ(fault.find("camera \"left\": "), 0U) << fault;
  EXPECT_NE(fault.find("views/000/left"), std::string::npos) << fault;
}

}  // namespace
}  // namespace frangia
