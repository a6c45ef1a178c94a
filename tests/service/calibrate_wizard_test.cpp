#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "service/live_service.h"

namespace frangia {
namespace {

using testing::error_of;
using testing::Json;
using testing::LiveServiceTest;
using testing::remove_turntable;

TEST_F(LiveServiceTest, CalibratesTheRigFromPosesThatItAsksFor) {
  EXPECT_NE(error_of([&] { command("capture-pose"); }), "") << "no calibration runs";
  command("start-calibration", {{"square_mm", 14.0}, {"poses", 4}});
  const auto calibration = [&] { return project().at("calibration"); };
  for (std::size_t pose = 0; pose < 4; ++pose) {
    ASSERT_TRUE(wait([&] {
      return (calibration().at("waiting").get<bool>() && calibration().at("found") == 70) ||
             !busy();
    })) << calibration();
    ASSERT_TRUE(busy()) << service_.state();
    EXPECT_EQ(calibration().at("poses").size(), pose);
    const Json seen = header(LiveLayer::Camera, [](const Json&) { return true; });
    EXPECT_EQ(length_of(seen, "corners"), 140U);
    command("capture-pose");
  }
  ASSERT_TRUE(wait([&] { return !busy(); }));
  const Json verdict = calibration().at("verdict");
  ASSERT_FALSE(verdict.is_null()) << service_.state();
  EXPECT_LT(verdict.at("point_sigma_mm").get<double>(), 0.2);
  EXPECT_FALSE(project().at("rig").at("calibration").is_null());
  const Rig known = read_rig(folder_.path() / "live" / "rig.toml");
  const Rig truth = read_rig(folder_.path() / "live" / "true-rig.toml");
  const double baseline = truth.projector.position_mm.norm();
  EXPECT_NE(known.projector.position_mm.norm(), baseline);
  EXPECT_NEAR(known.projector.position_mm.norm(), baseline, 0.01 * baseline);
  ASSERT_TRUE(known.turntable) << "the turntable stays";

  // The residuals by pose and over both images, and the report as a file.
  EXPECT_GT(project().at("residuals_s").get<std::int64_t>(), 0);
  const Json residuals = Json::parse(service_.residuals());
  ASSERT_EQ(residuals.at("poses").size(), 4U);
  ASSERT_EQ(residuals.at("maps").size(), 2U);
  const Json& map = residuals.at("maps")[0];
  EXPECT_EQ(map.at("width"), 640);
  EXPECT_EQ(map.at("points"), 4 * 70);
  double squares = 0.0;
  for (const Json& arrow : map.at("arrows"))
    squares += std::pow(arrow[2].get<double>(), 2) + std::pow(arrow[3].get<double>(), 2);
  EXPECT_NEAR(std::sqrt(squares / (4 * 70)), verdict.at("camera_rms_px").get<double>(), 1e-3);
  for (const Json& pose : residuals.at("poses"))
    EXPECT_FALSE(pose.at("outlier").get<bool>()) << pose;
  EXPECT_GT(std::filesystem::file_size(service_.exported("calibration.html").path), 10'000U);
}

/// Its markers tell size and number of the squares, its ruler how far the printer scaled them.
TEST_F(LiveServiceTest, CalibratesWithAPrintedBoardThatNamesItself) {
  EXPECT_NE(error_of([&] { command("start-calibration", {{"ruler_mm", 10.0}}); }), "");
  EXPECT_NE(error_of([&] { command("start-calibration"); }), "");
  command("start-calibration", {{"ruler_mm", 99.0}, {"poses", 3}});
  const auto calibration = [&] { return project().at("calibration"); };
  ASSERT_TRUE(wait([&] { return calibration().at("waiting").get<bool>() || !busy(); }));
  ASSERT_TRUE(busy()) << service_.state();
  EXPECT_FALSE(calibration().at("naming").get<bool>());
  const Json board = calibration().at("board");
  EXPECT_NEAR(board.at("square_mm").get<double>(), 14.0 * 0.99, 1e-9);
  EXPECT_EQ(board.at("columns"), 10);
  EXPECT_EQ(board.at("rows"), 7);
  for (std::size_t pose = 0; pose < 3; ++pose) {
    ASSERT_TRUE(wait([&] {
      return (calibration().at("waiting").get<bool>() && calibration().at("found") > 30 &&
              calibration().at("poses").size() == pose) ||
             !busy();
    }));
    ASSERT_TRUE(busy()) << service_.state();
    command("capture-pose");
  }
  ASSERT_TRUE(wait([&] { return !busy(); }));
  ASSERT_FALSE(calibration().at("verdict").is_null()) << service_.state();
  const Rig known = read_rig(folder_.path() / "live" / "rig.toml");
  const double baseline =
      read_rig(folder_.path() / "live" / "true-rig.toml").projector.position_mm.norm();
  EXPECT_NEAR(known.projector.position_mm.norm(), baseline, 0.01 * baseline);
}

TEST_F(LiveServiceTest, FindsTheAxisOfItsTurntableAndScansNoStationsBefore) {
  const std::filesystem::path file = folder_.path() / "live" / "rig.toml";
  const Turntable truth = read_rig(file).turntable.value();
  command("close-project");
  remove_turntable(file);
  const Rig simulated = read_rig(folder_.path() / "live" / "true-rig.toml");
  ASSERT_TRUE(simulated.turntable) << "the simulated table turns as before";
  command("open-project", {{"name", "live"}});
  ASSERT_TRUE(wait([&] { return !busy(); }));
  ASSERT_TRUE(project().at("rig").at("turntable").is_null());
  EXPECT_NE(error_of([&] { command("start-scan"); }).find("the axis of the turntable is unknown"),
            std::string::npos);
  EXPECT_NE(error_of([&] { command("find-axis"); }).find("the board is not known"),
            std::string::npos);

  command("find-axis", {{"square_mm", 14.0}, {"columns", 10}, {"rows", 7}});
  ASSERT_TRUE(wait([&] { return !busy(); }));
  const Json axis = project().at("axis");
  ASSERT_FALSE(axis.is_null()) << service_.state();
  EXPECT_GE(axis.at("views").get<int>(), 5);
  const Turntable found = read_rig(file).turntable.value();
  const double turned_rad = std::acos(std::min(1.0, found.axis.dot(truth.axis)));
  EXPECT_LT(turned_rad, 0.002);
  const Eigen::Vector3d between = found.point_mm - truth.point_mm;
  EXPECT_LT((between - between.dot(truth.axis) * truth.axis).norm(), 0.5);
  EXPECT_LT(axis.at("point_sigma_mm").get<double>(), 0.5);
  EXPECT_FALSE(project().at("rig").at("turntable").is_null());
  command("start-scan");
}

TEST_F(LiveServiceTest, FindsTheAxisByThePartThatStandsOnTheTable) {
  command("create-project", {{"name", "figure"}, {"part", "bust"}, {"stations", 2}});
  ASSERT_TRUE(wait([&] { return !busy(); }));
  const std::filesystem::path file = folder_.path() / "figure" / "rig.toml";
  const Turntable truth = read_rig(file).turntable.value();
  command("close-project");
  remove_turntable(file);
  command("open-project", {{"name", "figure"}});
  ASSERT_TRUE(wait([&] { return !busy(); }));
  command("find-axis", {{"part", true}});
  ASSERT_TRUE(wait([&] { return !busy(); }));
  const Json axis = project().at("axis");
  ASSERT_FALSE(axis.is_null()) << service_.state();
  EXPECT_EQ(axis.at("views").get<int>(), 8);
  const Turntable found = read_rig(file).turntable.value();
  EXPECT_LT(std::acos(std::min(1.0, found.axis.dot(truth.axis))), 0.002);
  const Eigen::Vector3d between = found.point_mm - truth.point_mm;
  EXPECT_LT((between - between.dot(truth.axis) * truth.axis).norm(), 0.2);
}

TEST_F(LiveServiceTest, ShowsTheCameraOfARigThatIsNotCalibrated) {
  command("create-project", {{"name", "maker"}, {"example", "simulated-maker"}, {"stations", 2}});
  ASSERT_TRUE(wait([&] { return !busy(); }));
  EXPECT_TRUE(project().at("rig").is_null());
  EXPECT_TRUE(project().at("rig_begun").get<bool>());
  EXPECT_TRUE(project().at("can_scan").get<bool>());
  command("start-live");
  const Json seen = header(LiveLayer::Depth, [](const Json&) { return true; });
  EXPECT_EQ(seen.at("values").at("layer"), "camera") << "there is no depth without a calibration";
  command("start-calibration", {{"square_mm", 14.0}, {"poses", 3}});
  ASSERT_TRUE(wait([&] {
    return project().at("calibration").is_object() && project().at("calibration").at("found") == 70;
  })) << service_.state();
  EXPECT_EQ(length_of(header(LiveLayer::Camera, [](const Json&) { return true; }), "corners"),
            140U);
}

}  // namespace
}  // namespace frangia
