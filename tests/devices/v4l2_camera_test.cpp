#include "frangia/devices/internal/v4l2_camera.h"

#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include "support/error_of.h"
#include "support/fake_webcam.h"

namespace frangia {
namespace {

using testing::error_of;
using testing::FakeWebcam;

Deadline at_once() {
  return Deadline::in(0.2);
}

V4l2Settings settings() {
  V4l2Settings wanted;
  wanted.width_px = FakeWebcam::kWidth;
  wanted.height_px = FakeWebcam::kHeight;
  return wanted;
}

TEST(V4l2Camera, AFrameIsExposedAfterTheRequestWithManualExposure) {
  const auto webcam = std::make_shared<FakeWebcam>();
  const auto camera = open_v4l2_camera(settings(), webcam);
  EXPECT_EQ(webcam->controls[V4L2_CID_EXPOSURE_AUTO], V4L2_EXPOSURE_MANUAL);
  EXPECT_DOUBLE_EQ(camera->configure({20.0, 0.0, 0.0}, at_once()).exposure_ms, 20.0);
  EXPECT_EQ(webcam->controls[V4L2_CID_EXPOSURE_ABSOLUTE], 200);
  static_cast<void>(webcam->wait_readable(7, 0));
  const int before = webcam->frame;
  const CapturedFrame captured = camera->capture({}, at_once());
  ASSERT_TRUE(captured.complete);
  EXPECT_GE(static_cast<int>(captured.id), before + 2) << "one is skipped";
}

TEST(V4l2Camera, SwitchesOffWhatChangesFramesAndRestoresItAtTheEnd) {
  const auto webcam = std::make_shared<FakeWebcam>();
  const std::map<unsigned, int> before = webcam->controls;
  {
    const auto camera = open_v4l2_camera(settings(), webcam);
    static_cast<void>(camera->configure({20.0, 0.0, 0.0}, at_once()));
    for (const int id : {V4L2_CID_EXPOSURE_AUTO_PRIORITY,
                         V4L2_CID_AUTO_WHITE_BALANCE,
                         V4L2_CID_FOCUS_AUTO,
                         V4L2_CID_BACKLIGHT_COMPENSATION,
                         V4L2_CID_POWER_LINE_FREQUENCY})
      EXPECT_EQ(webcam->controls[static_cast<unsigned>(id)], 0) << id;
    const std::vector<std::string> said = camera->take_warnings();
    ASSERT_EQ(said.size(), 1U) << "the focus stays as it is calibrated";
    EXPECT_NE(said.front().find("autofocus was on and is now off"), std::string::npos);
    EXPECT_TRUE(camera->take_warnings().empty());
  }
  std::map<unsigned, int> after = webcam->controls;
  EXPECT_EQ(std::exchange(after[V4L2_CID_FOCUS_AUTO], 1), 0);
  EXPECT_EQ(after, before);
}

TEST(V4l2Camera, NamesWhatStaysAutomatic) {
  const auto webcam = std::make_shared<FakeWebcam>();
  webcam->controls[V4L2_CID_FOCUS_AUTO] = 0;
  webcam->fixed = V4L2_CID_BACKLIGHT_COMPENSATION;
  webcam->stubborn = V4L2_CID_POWER_LINE_FREQUENCY;
  const auto camera = open_v4l2_camera(settings(), webcam);
  const std::vector<std::string> said = camera->take_warnings();
  ASSERT_EQ(said.size(), 2U);
  EXPECT_NE(said[0].find("backlight compensation cannot be switched off"), std::string::npos)
      << said[0];
  EXPECT_NE(said[1].find("flicker of lamps cannot be switched off (it keeps its value)"),
            std::string::npos)
      << said[1];
}

TEST(V4l2Camera, ReadsLuminanceFromGreyAndYuyv) {
  for (const unsigned format : {V4L2_PIX_FMT_GREY, V4L2_PIX_FMT_YUYV}) {
    const auto webcam = std::make_shared<FakeWebcam>();
    webcam->formats = {format};
    const auto camera = open_v4l2_camera(settings(), webcam);
    const CapturedFrame captured = camera->capture({}, at_once());
    ASSERT_TRUE(captured.complete);
    for (int x = 0; x < FakeWebcam::kWidth; ++x)
      EXPECT_EQ(counts_at(captured.frame, x, 5), x + 40 * (static_cast<int>(captured.id) % 4));
  }
}

TEST(V4l2Camera, DecodesMotionJpegAndStatesItsQuality) {
  const auto webcam = std::make_shared<FakeWebcam>();
  webcam->formats = {V4L2_PIX_FMT_MJPEG};
  const auto camera = open_v4l2_camera(settings(), webcam);
  EXPECT_EQ(camera->info().jpeg_quality, 75);
  EXPECT_NE(camera->test(at_once()).find("JPEG of quality 75"), std::string::npos);
  const CapturedFrame captured = camera->capture({}, at_once());
  ASSERT_TRUE(captured.complete) << captured.incomplete_cause;
  for (int x = 0; x < FakeWebcam::kWidth; ++x)
    EXPECT_NEAR(counts_at(captured.frame, x, 5), x + 40 * (static_cast<int>(captured.id) % 4), 3);
  webcam->broken = true;
  const CapturedFrame truncated = camera->capture({}, at_once());
  EXPECT_FALSE(truncated.complete);
  EXPECT_NE(truncated.incomplete_cause.find("truncated or damaged"), std::string::npos)
      << truncated.incomplete_cause;
  webcam->broken = false;
  webcam->quality = 40;
  const CapturedFrame worse = camera->capture({}, at_once());
  EXPECT_FALSE(worse.complete);
  EXPECT_NE(worse.incomplete_cause.find("fell from 75 to 40"), std::string::npos);
}

TEST(V4l2Camera, PrefersUncompressedFrames) {
  const auto webcam = std::make_shared<FakeWebcam>();
  webcam->formats = {V4L2_PIX_FMT_MJPEG, V4L2_PIX_FMT_YUYV};
  const auto camera = open_v4l2_camera(settings(), webcam);
  EXPECT_FALSE(camera->info().jpeg_quality.has_value());
}

TEST(V4l2Camera, MarksAShortFrameIncomplete) {
  const auto webcam = std::make_shared<FakeWebcam>();
  const auto camera = open_v4l2_camera(settings(), webcam);
  webcam->broken = true;
  const CapturedFrame captured = camera->capture({}, at_once());
  EXPECT_FALSE(captured.complete);
  EXPECT_EQ(captured.incomplete_cause, "10 of 512 bytes arrived");
}

TEST(V4l2Camera, ReportsFaultsInOneSentenceAndClosesTheCamera) {
  const auto webcam = std::make_shared<FakeWebcam>();
  {
    const auto camera = open_v4l2_camera(settings(), webcam);
    const auto take = [&] { static_cast<void>(camera->capture({}, at_once())); };
    EXPECT_NE(error_of([&] {
                static_cast<void>(camera->configure({9e9, 0, 0}, at_once()));
              }).find("outside its range, 0.1 to 500"),
              std::string::npos);
    webcam->silent = true;
    EXPECT_NE(error_of(take).find("no frame within 0.2 s"), std::string::npos);
    webcam->silent = false;
    webcam->gone = true;
    EXPECT_NE(error_of(take).find("is unplugged"), std::string::npos) << error_of(take);
  }
  EXPECT_TRUE(webcam->closed);
  EXPECT_EQ(webcam->unmapped, 3);
  const auto other = std::make_shared<FakeWebcam>();
  other->formats = {V4L2_PIX_FMT_H264};
  EXPECT_NE(error_of([&] {
              static_cast<void>(open_v4l2_camera(settings(), other));
            }).find("delivers neither grey, YUYV nor Motion JPEG images"),
            std::string::npos);
  V4l2Settings nobody = settings();
  nobody.path = "/dev/video9";
  EXPECT_NE(error_of([&] {
              static_cast<void>(open_v4l2_camera(nobody, webcam));
            }).find("camera /dev/video9: cannot be opened"),
            std::string::npos);
}

TEST(V4l2Camera, IsFoundWithItsSettings) {
  FakeWebcam webcam;
  const auto found = find_v4l2_cameras(webcam);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.front().name, "Fake webcam at /dev/video0");
  EXPECT_EQ(found.front().settings, "driver = \"v4l2\"\npath = \"/dev/video0\"\n");
}

}  // namespace
}  // namespace frangia
