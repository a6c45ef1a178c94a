#include <memory>

#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include "frangia/devices/internal/v4l2_camera.h"
#include "frangia/devices/internal/v4l2_system.h"

#include "support/error_of.h"
#include "support/fake_webcam.h"

namespace frangia {
namespace {

using testing::error_of;
using testing::FakeWebcam;

TEST(V4l2Modes, AreListedTheLeastCompressedAndLargestFirst) {
  FakeWebcam webcam;
  webcam.formats = {V4L2_PIX_FMT_MJPEG, V4L2_PIX_FMT_YUYV};
  webcam.sizes = {{320, 240}, {1280, 720}};
  webcam.rates = {10, 30};
  const std::vector<DeviceMode> modes = find_v4l2_cameras(webcam).at(0).modes;
  ASSERT_EQ(modes.size(), 8U);
  EXPECT_EQ(modes[0].name, "1280 x 720 pixels, YUYV, 30 /s");
  EXPECT_EQ(modes[0].settings,
            "size_px = [1280, 720]\npixel_format = \"yuyv\"\nframes_per_s = 30\n");
  EXPECT_EQ(modes[4].name, "1280 x 720 pixels, Motion JPEG, 30 /s");
}

TEST(V4l2Modes, GiveTheLargestImageWhereTheRigStatesNoSize) {
  const auto webcam = std::make_shared<FakeWebcam>();
  webcam->sizes = {{320, 240}, {1280, 720}, {640, 480}};
  static_cast<void>(open_v4l2_camera({.path = "/dev/video0"}, webcam));
  EXPECT_EQ(webcam->asked, std::pair(1280U, 720U));
}

TEST(V4l2Modes, GiveThePixelFormatAndTheRateThatAreAskedFor) {
  const auto webcam = std::make_shared<FakeWebcam>();
  webcam->formats = {V4L2_PIX_FMT_YUYV, V4L2_PIX_FMT_GREY};
  V4l2Settings settings{
      .path = "/dev/video0", .width_px = FakeWebcam::kWidth, .height_px = FakeWebcam::kHeight};
  settings.format = V4L2_PIX_FMT_YUYV;
  settings.fps = 15.0;
  const auto camera = open_v4l2_camera(settings, webcam);
  EXPECT_NE(camera->test(Deadline::in(1.0)).find("YUYV"), std::string::npos);
  EXPECT_DOUBLE_EQ(static_cast<double>(webcam->rate.denominator) / webcam->rate.numerator, 15.0);
  webcam->formats = {V4L2_PIX_FMT_GREY};
  EXPECT_NE(error_of([&] {
              static_cast<void>(open_v4l2_camera(settings, webcam));
            }).find("in this pixel_format"),
            std::string::npos);
}

}  // namespace
}  // namespace frangia
