#include "frangia/acquisition/measure_display.h"

#include <cmath>
#include <string>
#include <vector>

#include "frangia/acquisition/internal/choose_exposures.h"
#include "frangia/acquisition/internal/display_probe.h"
#include "frangia/acquisition/internal/room_light.h"
#include "frangia/acquisition/with_display.h"
#include "frangia/core/random.h"
#include "frangia/rig/read_rig.h"

#include "support/error_of.h"
#include "support/simulated_capture.h"

namespace frangia {
namespace {

using testing::error_of;

TEST(FlashLag, CountsFramesAndShareOfEveryLag) {
  for (std::size_t frames = 0; frames < kFlashCode.size(); ++frames) {
    for (const double share : {0.0, 0.3, 0.8}) {
      std::vector<double> light;
      for (std::size_t k = 0; k < 2 * kFlashCode.size(); ++k) {
        const auto flash = [&](std::size_t late) {
          return kFlashCode[(k + 2 * kFlashCode.size() - late) % kFlashCode.size()] ? 1.0 : 0.0;
        };
        light.push_back((1.0 - share) * flash(frames) + share * flash(frames + 1) +
                        0.02 * normal_from(hash(frames, k)));
      }
      const FlashLag lag = flash_lag(light);
      EXPECT_NEAR(
          static_cast<double>(lag.frames) + lag.share, static_cast<double>(frames) + share, 0.03);
      EXPECT_LT(lag.residual, 0.04);
    }
  }
  EXPECT_GT(flash_lag(std::vector<double>(15, 0.5)).residual, 0.2) << "it follows no flash";
}

TEST(CommonPeriod, HoldsWholePeriodsOfDisplayAndRoom) {
  EXPECT_NEAR(common_period_ms(1000.0 / 60.0, 10.0), 50.0, 1e-9);
  EXPECT_NEAR(common_period_ms(1000.0 / 60.0, 1000.0 / 120.0), 1000.0 / 60.0, 1e-9);
  EXPECT_EQ(common_period_ms(20.0, 10.0), 20.0);
  EXPECT_EQ(common_period_ms(0.0, 10.0), 10.0);
  EXPECT_EQ(common_period_ms(20.0, 0.0), 20.0);
  EXPECT_EQ(common_period_ms(0.0, 0.0), 0.0);
}

TEST(ExposureRaster, KeepsWholeStepsThatAreNotBrighter) {
  EXPECT_EQ(on_raster(34.0, 10.0), 30.0);
  EXPECT_EQ(on_raster(30.0, 10.0), 30.0);
  EXPECT_EQ(on_raster(4.0, 10.0), 4.0) << "too bright for one step";
  EXPECT_EQ(on_raster(34.0, 0.0), 34.0);
  const ExposureProbe probe = [](double exposure_ms) {
    return Image<PixelStatus>(
        4, 4, exposure_ms > 47.0 ? PixelStatus::Saturated : PixelStatus::Measured);
  };
  EXPECT_EQ(longest_exposure(probe, {.initial_ms = 5.0, .step_ms = 10.0}), 40.0);
}

class MeasureDisplay : public testing::SimulatedCapture {
 protected:
  MeasureDisplay() {
    use("digital", 16);
    devices_.erase("turntable");
    devices_.erase("light");
  }
  [[nodiscard]] DisplayMeasurement measured() const {
    RigDevices devices = open();
    const DisplayMeasurement found = measure_display(devices, plan_.rig);
    EXPECT_EQ(devices.display->delay_s(), 0.0) << "it is as it was opened";
    return found;
  }
};

TEST_F(MeasureDisplay, FindsTheFaultsThatTheRigWasGiven) {
  devices_["camera"] +=
      "display_gamma = 2.2\nambient = 0.1\nmains_hz = 50\nroom_flicker = 0.5\n"
      "clips_at_counts = 244\nreference_exposure_ms = 60\n";
  devices_["fringes"] += "latency_ms = 41\nrefresh_hz = 60\n";
  const DisplayMeasurement found = measured();
  EXPECT_NEAR(found.latency_s, 0.041, 0.002);
  EXPECT_GT(found.delay_s, 0.041);
  EXPECT_LT(found.delay_s, 0.050);
  EXPECT_EQ(found.late_frames, 0);
  EXPECT_EQ(found.mains_hz, 50.0);
  EXPECT_EQ(found.white_level, 244);
  EXPECT_NEAR(found.exposure_step_ms, 50.0, 0.01);
  EXPECT_NEAR(std::fmod(found.exposure_ms + 1.0, 50.0), 1.0, 0.01);
  for (const double level : {0.25, 0.5, 0.75})
    EXPECT_NEAR(found.response.value().light_of(level), std::pow(level, 2.2), 0.02);
  EXPECT_NEAR(found.camera_fps, 1000.0 / found.exposure_ms, 0.1);
  EXPECT_TRUE(found.findings.empty()) << found.findings.front();

  plan_.rig.projector.response = found.response;  // which the display compensates from now on
  EXPECT_NEAR(measured().response.value().light_of(0.5), std::pow(0.5, 2.2), 0.02);
}

TEST_F(MeasureDisplay, SeesFramesThatAreLateByOne) {
  devices_["camera"] += "late_frames = 1\n";
  const DisplayMeasurement late = measured();
  EXPECT_EQ(late.late_frames, 1);
  EXPECT_EQ(late.skip_frames, 1);
  devices_["camera"] += "skip_frames = 1\n";
  const DisplayMeasurement corrected = measured();
  EXPECT_EQ(corrected.late_frames, 0);
  EXPECT_EQ(corrected.mains_hz, 0.0);
  EXPECT_EQ(corrected.exposure_step_ms, 0.0) << "the light is steady";
  EXPECT_NEAR(corrected.latency_s, 0.0, 0.001);
}

TEST_F(MeasureDisplay, TellsABlurredPictureFromASharpOneAndWhereBlackIsCutOff) {
  const DisplayMeasurement sharp = measured();
  EXPECT_TRUE(sharp.findings.empty()) << sharp.findings.front();
  devices_["camera"] += "camera_blur_px = 1.5\ncontrast = 1.0\n";
  const DisplayMeasurement blurred = measured();
  EXPECT_LT(blurred.sharpness, 0.8 * sharp.sharpness);
  EXPECT_GT(blurred.dark_zeros, 0.5);
  EXPECT_NE(blurred.findings.back().find("level of black"), std::string::npos);
}

/// The part is white: the room adds its share of white to each pixel at the reference exposure.
TEST_F(MeasureDisplay, KnowsHowMuchTheRoomFlickersInBrightAndInDimLight) {
  constexpr double kAmbient = 0.1;
  constexpr double kFlicker = 0.5;
  constexpr double kShare = 0.8;  // of the reference exposure
  const std::string camera = devices_["camera"] + "ambient = 0.1\n";
  for (const double reference_ms : {10.0, 100.0}) {
    const std::string one =
        camera + "reference_exposure_ms = " + std::to_string(reference_ms) + "\n";
    devices_["camera"] = one;
    double full_counts = 0.0;
    {
      RigDevices devices = open();
      const CaptureOptions options;
      const frangia::Run run;
      DisplayProbe probe(devices, plan_.rig, options, run);
      probe.expose_for(kShare * reference_ms);
      const auto frames = probe.stack_of(dark_and_bright()).frames;
      full_counts = LitPixels(frames[0], frames[1], 255, 0.15).light_counts();
    }
    devices_["camera"] = one + "mains_hz = 50\nroom_flicker = 0.5\n";
    const double expected = kFlicker * kAmbient * kShare * 255.0 / full_counts;
    EXPECT_NEAR(measured().room_flicker, expected, 0.1 * expected) << reference_ms;
  }
}

/// 4 ms leave most of the flicker of 120 Hz, and any longer exposure is too bright.
TEST_F(MeasureDisplay, MeasuresNoResponseUnderLampsThatFlickerInItsFrames) {
  devices_["camera"] +=
      "display_gamma = 2.2\nambient = 0.1\nmains_hz = 60\nroom_flicker = 0.6\n"
      "reference_exposure_ms = 4\n";
  devices_["fringes"] += "latency_ms = 33\nrefresh_hz = 50\n";
  const DisplayMeasurement found = measured();
  EXPECT_EQ(found.mains_hz, 60.0);
  EXPECT_NEAR(found.latency_s, 0.033, 0.001);
  EXPECT_FALSE(found.response);
  EXPECT_NE(found.findings.back().find("darken the room"), std::string::npos);
  static_cast<void>(open());
  const std::string rig = testing::text_of(folder_.path() / "rig.toml");
  EXPECT_EQ(with_display(rig, plan_.rig, found).find("[projector.response]"), std::string::npos);
}

TEST_F(MeasureDisplay, RefusesWhatItCannotSee) {
  devices_["camera"] += "contrast = 0.001\nambient = 0.5\n";
  EXPECT_NE(error_of([&] { static_cast<void>(measured()); }).find("too few pixels"),
            std::string::npos);
  use("angular", 4);
  EXPECT_NE(error_of([&] { static_cast<void>(measured()); }).find("digital projector"),
            std::string::npos);
}

TEST_F(MeasureDisplay, WritesWhatItFoundAndLeavesTheRestOfTheRig) {
  static_cast<void>(open());
  const auto file = folder_.path() / "rig.toml";
  const std::string before = testing::text_of(file) + "# kept\n";
  DisplayMeasurement found;
  found.delay_s = 0.043;
  found.exposure_step_ms = 50.0;
  found.skip_frames = 2;
  found.white_level = 244;
  found.response = ResponseCurve{{0.0, 0.2, 1.0}};
  const std::string after = with_display(before, plan_.rig, found);
  EXPECT_NE(after.find("# kept"), std::string::npos);
  EXPECT_EQ(with_display(after, plan_.rig, found), after) << "each key is there once";
  std::ofstream(file) << after;
  const Rig rig = read_rig(file);
  EXPECT_EQ(rig.reference().white_level, 244);
  ASSERT_TRUE(rig.projector.response);
  EXPECT_NEAR(rig.projector.response->light_of(0.5), 0.2, 1e-9);
  const RigDevices devices = open_devices(file, rig, testing::all_drivers(), Deadline::in(10.0));
  EXPECT_EQ(devices.exposure_step_ms, 50.0);
  EXPECT_EQ(devices.display->delay_s(), 0.043);
  EXPECT_EQ(devices.reference()->info().skip_frames, 2);
  EXPECT_NE(error_of([&] { static_cast<void>(with_display("", plan_.rig, found)); }), "");
}

}  // namespace
}  // namespace frangia
