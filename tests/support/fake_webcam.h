#pragma once

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <deque>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <linux/videodev2.h>

#include "frangia/devices/internal/v4l2_system.h"

#include "support/webcam_jpeg.h"

namespace frangia::testing {

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
      const std::vector<std::uint8_t> jpeg = webcam_jpeg(kWidth, kHeight, quality, [&](int x, int) {
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

}  // namespace frangia::testing
