// The table [calibration] of rig.toml, and a rig.toml from before its calibration.
#include "frangia/rig/calibration.h"

#include <cmath>
#include <fstream>
#include <string>
#include <variant>

#include <gtest/gtest.h>

#include "frangia/rig/read_rig.h"
#include "frangia/rig/rig.h"
#include "frangia/rig/write_rig.h"

#include "support/error_of.h"
#include "support/temporary_folder.h"
#include "support/text_of.h"

namespace frangia {
namespace {

using testing::TemporaryFolder;

const std::string kSizesOnly = R"(format = "frangia-rig"
version = 1
[camera]
size_px = [1280, 1024]
[projector]
model = "pinhole"
size_px = [1280, 800]
[devices.camera]
driver = "simulated"
exposure_ms = 12.5
[devices.turntable]
driver = "grbl"
)";

std::filesystem::path save_known(const TemporaryFolder& folder, const std::string& text) {
  auto path = folder.path() / "known.toml";
  std::ofstream(path) << text;
  return path;
}

TEST(Calibration, OfAWrittenRigIsReadBack) {
  const TemporaryFolder folder;
  Rig rig =
      read_rig(save_known(folder, kSizesOnly + "[line]\nnormal = [1.0, 0.0, 0.0]\noffset_mm = 3\n"),
               {},
               RigContent::StartValues);
  rig.reference().model.focal_px = rig.reference().model.principal_point_px = {640.0, 512.0};
  rig.projector.model = rig.reference().model;
  rig.projector.position_mm = {100.0, 0.0, 0.0};
  rig.projector.rotation.setIdentity();
  rig.calibration = Calibration{.date = "2026-11-23",
                                .board = "checkerboard",
                                .poses = 12,
                                .camera_rms_px = 0.171,
                                .projector_rms_px = 0.324,
                                .point_sigma_mm = 0.0125,
                                .distance_mm = 480.0,
                                .sigma = {{"camera.focal_px", 0.41}, {"projector.x_mm", 0.02}},
                                .covariance_file = "rig-covariance.csv",
                                .covariance = {{"camera.focal_px", "projector.x_mm"},
                                               Eigen::Matrix2d{{0.1681, 0.002}, {0.002, 0.0004}}}};
  const auto path = folder.path() / "rig.toml";
  write_rig(path, rig, Durability::Buffered, folder.path() / "known.toml");
  const Rig back = read_rig(path);
  ASSERT_TRUE(back.calibration);
  EXPECT_EQ(back.calibration->date, "2026-11-23");
  EXPECT_EQ(back.calibration->poses, 12);
  EXPECT_EQ(back.calibration->camera_rms_px, 0.171);
  EXPECT_EQ(back.calibration->point_sigma_mm, 0.0125);
  EXPECT_EQ(back.calibration->sigma, rig.calibration->sigma);
  EXPECT_EQ(back.calibration->covariance_file, "rig-covariance.csv");
  EXPECT_EQ(back.calibration->covariance.parameters, rig.calibration->covariance.parameters);
  EXPECT_EQ(back.calibration->covariance.covariance, rig.calibration->covariance.covariance);
  std::filesystem::remove(folder.path() / "rig-covariance.csv");
  const std::string missing = testing::error_of([&] { static_cast<void>(read_rig(path)); });
  EXPECT_NE(missing.find("rig-covariance.csv"), std::string::npos) << missing;

  rig.calibration->covariance_file.clear();
  write_rig(folder.path() / "found.toml", rig);
  const Rig named = read_rig(folder.path() / "found.toml");
  EXPECT_EQ(named.calibration->covariance_file, "found-covariance.csv");
  EXPECT_EQ(named.calibration->covariance.covariance, rig.calibration->covariance.covariance);
}

TEST(WriteRig, CarriesTheDevicesOfAnotherFileOver) {
  const TemporaryFolder folder;
  const auto known = save_known(folder, kSizesOnly);
  const auto path = folder.path() / "rig.toml";
  const Rig rig = read_rig(known, {}, RigContent::StartValues);
  write_rig(path, rig, Durability::Buffered, known);
  const std::string text = testing::text_of(path);
  EXPECT_NE(text.find("[devices.camera]"), std::string::npos) << text;
  EXPECT_NE(text.find("exposure_ms = 12.5"), std::string::npos) << text;
  EXPECT_NE(text.find("[devices.turntable]"), std::string::npos) << text;
}

TEST(ReadRig, TakesStartValuesFromAFileThatHoldsSizesOnly) {
  const TemporaryFolder folder;
  const Rig rig = read_rig(save_known(folder, kSizesOnly), {}, RigContent::StartValues);
  EXPECT_EQ(rig.reference().model.width_px, 1280);
  EXPECT_TRUE(std::isnan(rig.reference().model.focal_px.x()));
  EXPECT_EQ(std::get<PinholeModel>(rig.projector.model).height_px, 800);
  EXPECT_TRUE(std::isnan(rig.projector.position_mm.x()));
}

TEST(ReadRig, NamesWhatACalibratedRigLacks) {
  const TemporaryFolder folder;
  const auto path = save_known(folder, kSizesOnly);
  const std::string message = testing::error_of([&] { static_cast<void>(read_rig(path)); });
  EXPECT_NE(message.find("camera.focal_px, camera.principal_point_px, "), std::string::npos)
      << message;
}

}  // namespace
}  // namespace frangia
