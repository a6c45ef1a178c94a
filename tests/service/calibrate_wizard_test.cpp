#include <gtest/gtest.h>

#include "service/live_service.h"

namespace frangia {
namespace {

using testing::error_of;
using testing::Json;
using testing::LiveServiceTest;

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
}

}  // namespace
}  // namespace frangia
