#include "frangia/devices/internal/aravis_camera.h"

#include <gtest/gtest.h>

#ifdef FRANGIA_WITH_ARAVIS

#include "support/error_of.h"
#include "support/fake_gige_camera.h"
#include "support/soon.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::error_of;
using testing::FakeExposure;
using testing::FakeGigeCamera;
using testing::soon;

/// A ramp, scaled by the exposure and the bit depth and offset by the black level.
int ramp(const FakeExposure& exposure, int x, int y) {
  const int white = exposure.bytes_per_px == 1 ? 255 : 65535;
  const double light = exposure.exposure_us / 10'000.0 * ((x + 3 * y) % 200) / 255.0;
  return std::min(white, static_cast<int>(light * white) + exposure.black_level);
}

void paint_ramp(const FakeExposure& exposure, std::uint8_t* pixels) {
  for (int y = 0; y < exposure.height_px; ++y) {
    for (int x = 0; x < exposure.width_px; ++x) {
      const int value = ramp(exposure, x, y);
      *pixels++ = static_cast<std::uint8_t>(value);
      if (exposure.bytes_per_px == 2) *pixels++ = static_cast<std::uint8_t>(value >> 8);
    }
  }
}

class AravisCameraTest : public ::testing::Test {
 protected:
  AravisCameraTest() : fake_("FRANGIA1", folder_.path(), paint_ramp) {}

  [[nodiscard]] static AravisSettings region(int width, int height) {
    AravisSettings settings;
    settings.id = "127.0.0.1";
    settings.region_px = {0, 0, width, height};
    return settings;
  }
  static void expect_ramp(const CapturedFrame& captured, const CameraInfo& info) {
    FakeExposure exposure;
    exposure.exposure_us = 1000.0 * captured.settings.exposure_ms;
    exposure.bytes_per_px = info.white_level > 255 ? 2 : 1;
    exposure.black_level = static_cast<int>(captured.settings.black_level_counts);
    int wrong = 0;
    for (int y = 0; y < info.height_px; ++y) {
      for (int x = 0; x < info.width_px; ++x)
        wrong += counts_at(captured.frame, x, y) != ramp(exposure, x, y) ? 1 : 0;
    }
    EXPECT_EQ(wrong, 0);
  }

  testing::TemporaryFolder folder_;
  FakeGigeCamera fake_;
};

TEST_F(AravisCameraTest, AFrameHasTheRequestedSettings) {
  const auto camera = open_aravis_camera(region(320, 240), soon());
  EXPECT_EQ(camera->info().width_px, 320);
  EXPECT_EQ(camera->info().white_level, 255);
  for (const double exposure_ms : {4.0, 8.0}) {
    const CameraSettings set = camera->configure({exposure_ms, 0.0, 7.0}, soon());
    EXPECT_DOUBLE_EQ(set.exposure_ms, exposure_ms);
    EXPECT_DOUBLE_EQ(set.black_level_counts, 7.0);
    const CapturedFrame captured = camera->capture({}, soon());
    ASSERT_TRUE(captured.complete) << captured.incomplete_cause;
    expect_ramp(captured, camera->info());
  }
}

TEST_F(AravisCameraTest, SixteenBitFramesKeepTheirDepth) {
  AravisSettings settings = region(320, 240);
  settings.pixel_format = "Mono16";
  const auto camera = open_aravis_camera(settings, soon());
  EXPECT_EQ(camera->info().white_level, 65535);
  static_cast<void>(camera->configure({5.0, 0.0, 0.0}, soon()));
  const CapturedFrame captured = camera->capture({}, soon());
  ASSERT_TRUE(captured.complete) << captured.incomplete_cause;
  expect_ramp(captured, camera->info());
}

TEST_F(AravisCameraTest, LostPacketsMakeFramesIncompleteAndOthersStayComplete) {
  const auto camera = open_aravis_camera(region(320, 240), soon());
  static_cast<void>(camera->configure({1.0, 0.0, 0.0}, soon()));
  fake_.set_packet_loss(0.005);
  int complete = 0;
  constexpr int kFrames = 20;
  for (int i = 0; i < kFrames; ++i) {
    const CapturedFrame captured = camera->capture({}, soon());
    if (captured.complete) {
      ++complete;
      expect_ramp(captured, camera->info());
    } else {
      EXPECT_FALSE(captured.incomplete_cause.empty());
    }
  }
  EXPECT_GT(complete, 0);
  EXPECT_LT(complete, kFrames)
      << "a loss of 0.5 % of about 60 packets per frame affects a quarter of the frames";
}

TEST_F(AravisCameraTest, UnsupportedSettingsAreRefusedInOneSentence) {
  const auto camera = open_aravis_camera(region(320, 240), soon());
  const std::string sentence = error_of([&] {
    static_cast<void>(camera->configure({1e9, 0.0, 0.0}, soon()));
  });
  EXPECT_NE(sentence.find("outside its range"), std::string::npos) << sentence;
  EXPECT_NE(error_of([] {
              AravisSettings nobody;
              nobody.id = "no-such-camera";
              static_cast<void>(open_aravis_camera(nobody, soon()));
            }).find("camera no-such-camera: cannot be opened"),
            std::string::npos);
}

TEST_F(AravisCameraTest, ADisconnectedCameraIsReported) {
  const auto camera = open_aravis_camera(region(320, 240), soon());
  static_cast<void>(camera->configure({1.0, 0.0, 0.0}, soon()));
  fake_.stop();
  const auto begun = Deadline::Clock::now();
  EXPECT_THROW(static_cast<void>(camera->capture({}, Deadline::in(3.0))), Error);
  EXPECT_LT(Deadline::Clock::now() - begun, std::chrono::seconds(8));
}

}  // namespace
}  // namespace frangia

#endif
