#include "frangia/acquisition/find_exposures.h"

#include "support/simulated_capture.h"

namespace frangia {
namespace {

class FindExposures : public testing::SimulatedCapture {
 protected:
  double found_at(std::optional<double> table_rad) {
    RigDevices devices = open();
    CaptureOptions options;
    options.exposure = ExposureChoice::Automatic;
    return find_exposures(devices, plan_.rig, plan_.patterns, options, table_rad).front();
  }
};

/// A shiny plate is brightest where it faces the light.
TEST_F(FindExposures, MeasuresThePartAtTheAngleThatIsGiven) {
  devices_["camera"] += "gloss = 0.5\n";
  devices_["turntable"] += "home = \"switch\"\n";
  const double at_start_ms = found_at(std::nullopt);
  EXPECT_EQ(found_at(0.0), at_start_ms);
  EXPECT_GT(std::abs(found_at(rad_from_deg(60.0)) / at_start_ms - 1.0), 0.1);
}

TEST_F(FindExposures, WarnsOfAnExposureThatSeesUnevenLightAndChoosesNone) {
  devices_["camera"] += "exposure_step_ms = 2.5\n";
  const double found_ms = found_at(std::nullopt);
  EXPECT_NEAR(std::remainder(found_ms, 2.5), 0.0, 1e-9) << found_ms;
  views(1);
  CaptureOptions options;
  options.camera.exposure_ms = 7.5;
  static_cast<void>(capture(options));
  EXPECT_TRUE(warnings_.empty());
  plan_.folder = folder_.path() / "uneven";
  options.camera.exposure_ms = 6.0;
  static_cast<void>(capture(options));
  ASSERT_EQ(warnings_.size(), 1U);
  EXPECT_NE(warnings_.front().find("expose for 5 ms"), std::string::npos) << warnings_.front();
}

TEST_F(FindExposures, DoesNotTurnATableThatCannotFindItsAngle) {
  devices_["camera"] += "gloss = 0.5\n";
  devices_["turntable"] += "home = \"here\"\nfaults = [\"stuck 60\"]\n";
  EXPECT_EQ(found_at(rad_from_deg(60.0)), found_at(std::nullopt));
}

}  // namespace
}  // namespace frangia
