#include "frangia/service/rig_history.h"

#include <fstream>

#include <gtest/gtest.h>

#include "frangia/core/read_file.h"
#include "frangia/rig/read_rig.h"
#include "frangia/rig/write_rig.h"
#include "frangia/service/example_rigs.h"
#include "frangia/simulate/rig_presets.h"

#include "support/error_of.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::error_of;

/// A project whose rig has a baseline and, with a sigma, a calibration with covariance.
class RigHistoryTest : public ::testing::Test {
 protected:
  void write(double baseline_mm, double sigma_mm = 0.0) const {
    Rig rig = rig_preset("digital");
    rig.projector.position_mm = baseline_mm * rig.projector.position_mm.normalized();
    if (sigma_mm > 0.0) {
      Calibration calibration;
      calibration.date = "2026-11-26";
      calibration.poses = 12;
      calibration.point_sigma_mm = sigma_mm;
      calibration.distance_mm = 400.0;
      calibration.sigma = {{"camera.focal_px", sigma_mm}};
      calibration.covariance.parameters = {"camera.focal_px"};
      calibration.covariance.covariance = Eigen::MatrixXd::Constant(1, 1, sigma_mm * sigma_mm);
      rig.calibration = calibration;
    }
    write_rig(project_.rig(), rig);
  }
  [[nodiscard]] double baseline() const {
    return read_rig(project_.rig()).projector.position_mm.norm();
  }

  testing::TemporaryFolder folder_;
  ProjectLibrary library_{folder_.path()};
  ProjectFolder project_ = library_.create("part");
};

TEST_F(RigHistoryTest, BringsARigBackWithTheUncertaintyOfItsCalibration) {
  write(120.0, 0.01);
  std::ofstream(project_.residuals()) << "first";
  keep_rig(project_, RigChange::Calibration);
  write(150.0, 0.02);
  std::ofstream(project_.residuals()) << "second";
  ASSERT_EQ(kept_rigs(project_).size(), 1U);
  EXPECT_EQ(kept_rigs(project_)[0].before, "calibration");
  EXPECT_EQ(kept_rigs(project_)[0].figures.date, "2026-11-26");
  EXPECT_DOUBLE_EQ(kept_rigs(project_)[0].figures.point_sigma_mm, 0.01);
  EXPECT_TRUE(kept_rigs(project_)[0].figures.has_axis);

  restore_rig(project_, 1);
  EXPECT_NEAR(baseline(), 120.0, 1e-9);
  const Rig back = read_rig(project_.rig());
  EXPECT_DOUBLE_EQ(back.calibration->point_sigma_mm, 0.01);
  EXPECT_DOUBLE_EQ(back.calibration->covariance.covariance(0, 0), 1e-4);
  EXPECT_EQ(read_text_file(project_.residuals()), "first");

  ASSERT_EQ(kept_rigs(project_).size(), 2U) << "what was replaced is kept as well";
  restore_rig(project_, kept_rigs(project_)[0].number);
  EXPECT_NEAR(baseline(), 150.0, 1e-9);
  EXPECT_EQ(read_text_file(project_.residuals()), "second");
  EXPECT_NE(error_of([&] { restore_rig(project_, 99); }), "");
}

TEST_F(RigHistoryTest, KeepsTheRigBeforeARowOfMovesAndNoMoreThanItShould) {
  write(120.0);
  for (int i = 0; i < 3; ++i) {
    keep_rig(project_, RigChange::Geometry);
    write(130.0 + i);
  }
  ASSERT_EQ(kept_rigs(project_).size(), 1U);
  for (std::size_t i = 0; i < kMostKeptRigs + 2; ++i)
    keep_rig(project_, RigChange::Devices);
  const auto kept = kept_rigs(project_);
  EXPECT_EQ(kept.size(), kMostKeptRigs);
  EXPECT_EQ(kept.front().number, static_cast<int>(kMostKeptRigs) + 3);
  restore_rig(project_, kept.back().number);
  EXPECT_EQ(kept_rigs(project_).size(), kMostKeptRigs);
}

TEST_F(RigHistoryTest, KeepsRigsForOtherProjectsAndMakesNoPathFromTheirNames) {
  write(140.0, 0.03);
  const RigLibrary rigs(folder_.path() / ".rigs");
  rigs.keep(project_, "Bench");
  EXPECT_NE(error_of([&] { rigs.keep(project_, "Bench"); }), "");
  EXPECT_NE(error_of([&] { rigs.keep(project_, "../Bench"); }), "");
  ASSERT_EQ(rigs.list().size(), 1U);
  EXPECT_EQ(rigs.list()[0].name, "Bench");
  EXPECT_TRUE(library_.list().size() == 1) << "a rig is no project";

  const ProjectFolder other = library_.create("other");
  rigs.give("Bench", other);
  const Rig given = read_rig(other.rig());
  EXPECT_NEAR(given.projector.position_mm.norm(), 140.0, 1e-9);
  EXPECT_DOUBLE_EQ(given.calibration->covariance.covariance(0, 0), 9e-4);
  for (const char* name : {"../part", "..", "", "/etc", "Bench/"})
    EXPECT_NE(error_of([&] { rigs.give(name, other); }), "") << name;
  static_cast<void>(library_.create("rigs"));
  library_.discard("rigs");
  const auto bin = folder_.path() / ".rigs" / ".bin";
  std::filesystem::create_directory_symlink(folder_.path(), bin);
  EXPECT_NE(error_of([&] { rigs.discard("Bench"); }), "") << "the bin leads elsewhere";
  std::filesystem::remove(bin);
  rigs.discard("Bench");
  EXPECT_TRUE(rigs.list().empty());
  EXPECT_TRUE(std::filesystem::exists(bin / "Bench" / "rig.toml"));
  static_cast<void>(library_.take_back("rigs"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "rigs" / "Bench")) << "a rig of nobody";
}

TEST_F(RigHistoryTest, KeepsARigCompletelyOrNotAtAll) {
  write(140.0, 0.03);
  const RigLibrary rigs(folder_.path() / ".rigs");
  std::ofstream(project_.residuals()) << "";
  std::filesystem::resize_file(project_.residuals(), 64'000'001);  // more than is copied
  EXPECT_NE(error_of([&] { rigs.keep(project_, "Bench"); }), "");
  EXPECT_TRUE(rigs.list().empty());
  std::filesystem::remove(project_.residuals());
  EXPECT_EQ(error_of([&] { rigs.keep(project_, "Bench"); }), "") << "the name is still free";
  EXPECT_EQ(rigs.list().size(), 1U);
}

}  // namespace
}  // namespace frangia
