#include "frangia/devices/internal/v4l2_camera.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <deque>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include "support/error_of.h"
#include "support/webcam_jpeg.h"

namespace frangia {
namespace {

using testing::error_of;

/// A webcam behind the system calls: free-running, with a new frame for each wait.
class FakeWebcam final : public V4l2System {
 public:
  static constexpr int kWidth = 32;
  static constexpr int kHeight = 8;
  static constexpr unsigned kMostBytes = 65'536;  // of a compressed frame

  [[nodiscard]] int open(const char* path) override {
    if (std::string(path) == "/dev/video0") return 7;
    errno = ENOENT;
    return -1;
  }
  void close(int /*file*/) override { closed = true; }
  [[nodiscard]] void* map(std::size_t length, int /*file*/, std::size_t offset) override {
    memory_.at(offset).resize(length);
    return memory_.at(offset).data();
  }
  void unmap(void* /*memory*/, std::size_t /*length*/) override { ++unmapped; }
  [[nodiscard]] double now_s() override { return now_; }

  /// Advances the time and exposes the next frame into the oldest buffer.
  [[nodiscard]] int wait_readable(int /*file*/, int /*milliseconds*/) override {
    if (silent) return 0;
    now_ += 0.040;
    if (queued_.empty()) return 0;
    paint(memory_.at(queued_.front()));
    return 1;
  }

  [[nodiscard]] int ioctl(int /*file*/, unsigned long request, void* argument) override {
    if (gone) return refuse(ENODEV);
    switch (request) {
      case VIDIOC_QUERYCAP: {
        auto* answer = static_cast<v4l2_capability*>(argument);
        std::strncpy(reinterpret_cast<char*>(answer->card), "Fake webcam", 31);
        answer->capabilities = V4L2_CAP_DEVICE_CAPS;
        answer->device_caps = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
        return 0;
      }
      case VIDIOC_S_FMT:
        return set_format(static_cast<v4l2_format*>(argument)->fmt.pix);
      case VIDIOC_QUERYCTRL: {
        auto* answer = static_cast<v4l2_queryctrl*>(argument);
        if (controls.count(answer->id) == 0) return refuse(EINVAL);
        answer->minimum = 1;
        answer->maximum = 5000;
        return 0;
      }
      case VIDIOC_G_CTRL: {
        auto* setting = static_cast<v4l2_control*>(argument);
        if (controls.count(setting->id) == 0) return refuse(EINVAL);
        setting->value = controls[setting->id];
        return 0;
      }
      case VIDIOC_S_CTRL: {
        const auto* setting = static_cast<v4l2_control*>(argument);
        if (controls.count(setting->id) == 0) return refuse(EINVAL);
        const bool is_exposure = setting->id == V4L2_CID_EXPOSURE_ABSOLUTE;
        if (setting->id == fixed) return refuse(EACCES);
        if (is_exposure && controls[V4L2_CID_EXPOSURE_AUTO] != V4L2_EXPOSURE_MANUAL)
          return refuse(EACCES);  // as the driver of USB cameras
        if (setting->id != stubborn) controls[setting->id] = setting->value;
        return 0;
      }
      case VIDIOC_QUERYBUF: {
        auto* answer = static_cast<v4l2_buffer*>(argument);
        answer->length = format_ == V4L2_PIX_FMT_MJPEG ? kMostBytes : row_bytes() * kHeight;
        answer->m.offset = answer->index;
        return 0;
      }
      case VIDIOC_QBUF:
        queued_.push_back(static_cast<v4l2_buffer*>(argument)->index);
        return 0;
      case VIDIOC_DQBUF:
        return hand_out(*static_cast<v4l2_buffer*>(argument));
      case VIDIOC_STREAMON:
        return 0;
      case VIDIOC_STREAMOFF:
        queued_.clear();
        return 0;
      case VIDIOC_REQBUFS:
        return 0;
      case VIDIOC_ENUM_FRAMESIZES: {
        auto* entry = static_cast<v4l2_frmsizeenum*>(argument);
        const bool can =
            std::find(formats.begin(), formats.end(), entry->pixel_format) != formats.end();
        if (!can || entry->index >= sizes.size()) return refuse(EINVAL);
        entry->type = V4L2_FRMSIZE_TYPE_DISCRETE;
        std::tie(entry->discrete.width, entry->discrete.height) = sizes[entry->index];
        return 0;
      }
      case VIDIOC_ENUM_FRAMEINTERVALS: {
        auto* entry = static_cast<v4l2_frmivalenum*>(argument);
        if (entry->index >= rates.size()) return refuse(EINVAL);
        entry->type = V4L2_FRMIVAL_TYPE_DISCRETE;
        entry->discrete = {1, rates[entry->index]};
        return 0;
      }
      case VIDIOC_S_PARM:
        rate = static_cast<v4l2_streamparm*>(argument)->parm.capture.timeperframe;
        return 0;
      default:
        return refuse(ENOTTY);
    }
  }

  std::vector<unsigned> formats = {V4L2_PIX_FMT_YUYV};
  std::vector<std::pair<unsigned, unsigned>> sizes;  ///< that it lists
  std::vector<unsigned> rates;                       ///< that it lists, images per second
  v4l2_fract rate{};                                 ///< seconds per image that it was set to
  std::pair<unsigned, unsigned> asked;               ///< size of the last format that was set
  std::map<unsigned, int> controls = {
      ///< as many a webcam has when it is plugged in
      {V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_APERTURE_PRIORITY},
      {V4L2_CID_EXPOSURE_AUTO_PRIORITY, 1},
      {V4L2_CID_EXPOSURE_ABSOLUTE, 156},
      {V4L2_CID_AUTO_WHITE_BALANCE, 1},
      {V4L2_CID_FOCUS_AUTO, 1},
      {V4L2_CID_BACKLIGHT_COMPENSATION, 2},
      {V4L2_CID_POWER_LINE_FREQUENCY, V4L2_CID_POWER_LINE_FREQUENCY_60HZ}};
  unsigned fixed = 0;     ///< a control that is refused
  unsigned stubborn = 0;  ///< a control that is accepted and keeps its value
  bool gone = false;
  bool silent = false;
  bool broken = false;
  bool closed = false;
  int unmapped = 0;
  int frame = 0;
  int quality = 75;  ///< of compressed frames

 private:
  static int refuse(int code) {
    errno = code;
    return -1;
  }
  [[nodiscard]] unsigned row_bytes() const {
    return format_ == V4L2_PIX_FMT_GREY ? kWidth + 4 : 2 * kWidth;
  }
  int set_format(v4l2_pix_format& wanted) {
    const bool can = std::find(formats.begin(), formats.end(), wanted.pixelformat) != formats.end();
    if (!can)
      wanted.pixelformat = formats.front();  // drivers substitute a format that they support
    format_ = wanted.pixelformat;
    asked = {wanted.width, wanted.height};
    wanted.width = kWidth;
    wanted.height = kHeight;
    wanted.bytesperline = row_bytes();
    return 0;
  }
  /// The luminance encodes the frame, the column and the exposure.
  void paint(std::vector<std::uint8_t>& pixels) {
    ++frame;
    if (format_ == V4L2_PIX_FMT_MJPEG) {
      const std::vector<std::uint8_t> jpeg =
          testing::webcam_jpeg(kWidth, kHeight, quality, [&](int x, int) {
            return static_cast<std::uint8_t>(x + 40 * (frame % 4));
          });
      jpeg_bytes_ = static_cast<unsigned>(jpeg.size());
      std::copy(jpeg.begin(), jpeg.end(), pixels.begin());
      return;
    }
    const std::size_t step = format_ == V4L2_PIX_FMT_GREY ? 1 : 2;
    std::fill(pixels.begin(), pixels.end(), std::uint8_t{128});  // colour
    for (std::size_t y = 0; y < kHeight; ++y) {
      for (std::size_t x = 0; x < kWidth; ++x) {
        pixels[y * row_bytes() + step * x] =
            static_cast<std::uint8_t>(x + 40 * static_cast<std::size_t>(frame % 4));
      }
    }
  }
  int hand_out(v4l2_buffer& buffer) {
    buffer.index = queued_.front();
    queued_.pop_front();
    if (format_ == V4L2_PIX_FMT_MJPEG) {
      buffer.bytesused = broken ? jpeg_bytes_ - 10 : jpeg_bytes_;
    } else {
      buffer.bytesused = broken ? 10 : row_bytes() * kHeight;
    }
    buffer.sequence = static_cast<unsigned>(frame);
    buffer.timestamp.tv_sec = static_cast<long>(now_);
    buffer.timestamp.tv_usec =
        static_cast<long>(1e6 * (now_ - static_cast<double>(buffer.timestamp.tv_sec)));
    return 0;
  }

  double now_ = 100.0;
  unsigned format_ = 0;
  unsigned jpeg_bytes_ = 0;
  std::array<std::vector<std::uint8_t>, 3> memory_;
  std::deque<unsigned> queued_;
};

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

TEST(V4l2Camera, ListsItsModesTheLeastCompressedAndLargestFirst) {
  FakeWebcam webcam;
  webcam.formats = {V4L2_PIX_FMT_MJPEG, V4L2_PIX_FMT_YUYV};
  webcam.sizes = {{320, 240}, {1280, 720}};
  webcam.rates = {10, 30};
  const std::vector<DeviceMode> modes = find_v4l2_cameras(webcam).at(0).modes;
  ASSERT_EQ(modes.size(), 8U);
  EXPECT_EQ(modes[0].name, "1280 x 720 pixels, YUYV, 30 /s");
  EXPECT_EQ(modes[0].settings,
            "size_px = [1280, 720]\npixel_format = \"yuyv\"\nframes_per_s = 30\n");
  EXPECT_EQ(modes[3].name, "320 x 240 pixels, YUYV, 10 /s");
  EXPECT_EQ(modes[4].name, "1280 x 720 pixels, Motion JPEG, 30 /s");
}

TEST(V4l2Camera, TakesTheLargestImageWhereTheRigStatesNoSize) {
  const auto webcam = std::make_shared<FakeWebcam>();
  webcam->sizes = {{320, 240}, {1280, 720}, {640, 480}};
  const auto camera = open_v4l2_camera({.path = "/dev/video0"}, webcam);
  EXPECT_EQ(webcam->asked, std::pair(1280U, 720U));
}

TEST(V4l2Camera, TakesThePixelFormatAndTheRateThatAreAskedFor) {
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
