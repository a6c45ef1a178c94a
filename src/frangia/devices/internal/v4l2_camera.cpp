#include "frangia/devices/internal/v4l2_camera.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <linux/videodev2.h>

#include "frangia/devices/internal/v4l2_system.h"
#include "frangia/frames/decode_mjpeg.h"

namespace frangia {
namespace {

constexpr unsigned kMappedBuffers = 3;
constexpr double kExposureUnit_ms = 0.1;  // of V4L2_CID_EXPOSURE_ABSOLUTE

template <typename T>
T zeroed() {
  T value;
  std::memset(&value, 0, sizeof value);
  return value;
}

class V4l2Camera final : public CameraDevice {
 public:
  V4l2Camera(const V4l2Settings& settings, std::shared_ptr<V4l2System> system)
      : system_(std::move(system)),
        settings_(settings),
        name_("camera " + settings.path),
        file_(system_->open(settings.path.c_str())) {
    if (file_ < 0) {
      fail(errno == EBUSY ? "is in use by another program; close that one"
                          : fmt::format("cannot be opened ({}); run 'frangia devices' to list the "
                                        "cameras, and check that your user is in the group video",
                                        std::generic_category().message(errno)));
    }
    try {
      prepare();
    } catch (...) {
      close();
      throw;
    }
  }
  V4l2Camera(const V4l2Camera&) = delete;
  V4l2Camera& operator=(const V4l2Camera&) = delete;
  V4l2Camera(V4l2Camera&&) = delete;
  V4l2Camera& operator=(V4l2Camera&&) = delete;
  ~V4l2Camera() override { close(); }

  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] const CameraInfo& info() const override { return info_; }
  [[nodiscard]] std::string test(const Deadline& /*deadline*/) override {
    auto capability = zeroed<v4l2_capability>();
    control("report its capabilities", VIDIOC_QUERYCAP, capability);
    return fmt::format("{}, {} x {} pixels, {}",
                       reinterpret_cast<const char*>(capability.card),  // NOLINT
                       info_.width_px,
                       info_.height_px,
                       format_ == V4L2_PIX_FMT_GREY ? "grey"
                       : format_ == V4L2_PIX_FMT_YUYV
                           ? "YUYV"
                           : fmt::format("JPEG of quality {}", info_.jpeg_quality.value_or(0)));
  }
  [[nodiscard]] std::vector<std::string> take_warnings() override {
    return std::exchange(warnings_, {});
  }
  void make_safe() noexcept override { stop(); }

  CameraSettings configure(const CameraSettings& settings, const Deadline& deadline) override {
    deadline.check();
    check_exposure(settings.exposure_ms);
    if (settings.black_level_counts != 0.0) fail("its black level cannot be set; leave it at 0");
    if (settings.gain_db != 0.0) fail("its gain has no known unit; leave it at 0 dB");
    const int units = static_cast<int>(std::lround(settings.exposure_ms / kExposureUnit_ms));
    set("its exposure", V4L2_CID_EXPOSURE_ABSOLUTE, units);
    exposure_ms_ = kExposureUnit_ms * units;
    return {exposure_ms_, 0.0, 0.0};
  }

  [[nodiscard]] CapturedFrame capture(const FrameLabel& /*label*/,
                                      const Deadline& deadline) override {
    start();
    const double asked_s = system_->now_s();
    int skipped = 0;
    for (;;) {
      deadline.check();
      if (deadline.passed()) {
        fail(fmt::format("no frame within {:.3g} s; check that it is plugged in",
                         deadline.timeout_s));
      }
      constexpr int kPiece_ms = 20;
      const int ready = system_->wait_readable(file_, kPiece_ms);
      if (ready < 0 && errno != EINTR) fail_lost();
      if (ready <= 0) continue;
      v4l2_buffer buffer = empty_buffer(0);
      if (system_->ioctl(file_, VIDIOC_DQBUF, &buffer) < 0) {
        if (errno == EAGAIN) continue;
        fail_lost();
      }
      // The time stamp is of the end of the exposure. Frames that began before the request are
      // skipped.
      const double stamp_s = static_cast<double>(buffer.timestamp.tv_sec) +
                             1e-6 * static_cast<double>(buffer.timestamp.tv_usec);
      const bool old = stamp_s - 1e-3 * exposure_ms_ < asked_s || skipped < settings_.skip_frames;
      CapturedFrame captured = old ? CapturedFrame{} : frame_of(buffer, stamp_s);
      if (system_->ioctl(file_, VIDIOC_QBUF, &buffer) < 0) fail_lost();
      if (!old) return captured;
      ++skipped;
    }
  }

 private:
  struct MappedBuffer {
    void* memory = nullptr;
    std::size_t length = 0;
  };

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorKind::Device, name_ + ": " + what);
  }
  [[noreturn]] void fail_lost() const {
    fail(errno == ENODEV ? "is unplugged; plug it in and scan again"
                         : fmt::format("its frames stopped ({}); reconnect it",
                                       std::generic_category().message(errno)));
  }
  template <typename T>
  void control(const char* what, unsigned long request, T& argument) {
    if (system_->ioctl(file_, request, &argument) >= 0) return;
    if (errno == ENODEV) fail_lost();
    fail(fmt::format(
        "cannot {} ({})",
        what,
        errno == EBUSY ? "in use by another program" : std::generic_category().message(errno)));
  }
  void set(const char* what, unsigned id, int value) {
    v4l2_control setting{id, value};
    control(fmt::format("set {}", what).c_str(), VIDIOC_S_CTRL, setting);
  }
  static v4l2_buffer empty_buffer(unsigned index) {
    auto buffer = zeroed<v4l2_buffer>();
    buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    buffer.memory = V4L2_MEMORY_MMAP;
    buffer.index = index;
    return buffer;
  }

  void prepare() {
    auto capability = zeroed<v4l2_capability>();
    control("report its capabilities", VIDIOC_QUERYCAP, capability);
    const unsigned able = (capability.capabilities & V4L2_CAP_DEVICE_CAPS) != 0
                              ? capability.device_caps
                              : capability.capabilities;
    if ((able & V4L2_CAP_VIDEO_CAPTURE) == 0 || (able & V4L2_CAP_STREAMING) == 0)
      fail("is not a camera; run 'frangia devices' to list the cameras");
    choose_format();
    // Webcams meter automatically, but a scan needs equal exposures.
    V4l2Automatics automatics = switch_off_automatics(*system_, file_);
    before_ = std::move(automatics.before);
    warnings_ = std::move(automatics.warnings);
    V4l2Control exposure{V4L2_CID_EXPOSURE_ABSOLUTE, 0};
    if (get_control(*system_, file_, exposure)) before_.push_back(exposure);
    auto range = zeroed<v4l2_queryctrl>();
    range.id = V4L2_CID_EXPOSURE_ABSOLUTE;
    control("report its exposure range", VIDIOC_QUERYCTRL, range);
    info_.min_exposure_ms = kExposureUnit_ms * range.minimum;
    info_.max_exposure_ms = kExposureUnit_ms * range.maximum;
    map_buffers();
    if (is_compressed()) read_quality();
  }

  [[nodiscard]] bool is_compressed() const {
    return format_ == V4L2_PIX_FMT_MJPEG || format_ == V4L2_PIX_FMT_JPEG;
  }

  /// Reads the quality of the compression from the first frame that arrives, rounded down: webcams
  /// vary it a little.
  void read_quality() {
    constexpr double kTimeout_s = 5.0;
    constexpr int kStep = 5;
    const CapturedFrame first = capture({}, Deadline::in(kTimeout_s));
    if (!first.complete)
      fail(fmt::format("its first frame is damaged: {}", first.incomplete_cause));
    info_.jpeg_quality = std::max(1, quality_ / kStep * kStep);
  }

  void choose_format() {
    if (settings_.width_px == 0) {
      const std::vector<V4l2Mode> modes = v4l2_modes(*system_, file_);
      if (modes.empty()) fail("does not list its sizes; choose size_px = [width, height]");
      settings_.width_px = modes.front().width_px;
      settings_.height_px = modes.front().height_px;
    }
    for (const auto& [name, format, people] : v4l2_formats()) {
      if (settings_.format != 0 && format != settings_.format) continue;
      auto wanted = zeroed<v4l2_format>();
      wanted.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
      wanted.fmt.pix.width = static_cast<unsigned>(settings_.width_px);
      wanted.fmt.pix.height = static_cast<unsigned>(settings_.height_px);
      wanted.fmt.pix.pixelformat = format;
      wanted.fmt.pix.field = V4L2_FIELD_NONE;
      const int code = system_->ioctl(file_, VIDIOC_S_FMT, &wanted);
      if (code < 0 && errno == EBUSY) fail("is in use by another program; close that one");
      if (code < 0 || wanted.fmt.pix.pixelformat != format) continue;
      format_ = format;
      row_bytes_ = wanted.fmt.pix.bytesperline;
      info_.width_px = static_cast<int>(wanted.fmt.pix.width);
      info_.height_px = static_cast<int>(wanted.fmt.pix.height);
      info_.white_level = 255;
      info_.skip_frames = settings_.skip_frames;
      choose_rate();
      return;
    }
    fail(settings_.format == 0
             ? "delivers neither grey, YUYV nor Motion JPEG images of this size; use another "
               "camera or a smaller size"
             : "does not deliver images of this size in this pixel_format; choose another mode");
  }

  /// A camera that has no such rate takes the nearest one, or leaves its own.
  void choose_rate() {
    if (settings_.fps <= 0.0) return;
    constexpr unsigned kParts = 1000;
    auto rate = zeroed<v4l2_streamparm>();
    rate.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    rate.parm.capture.timeperframe.numerator = kParts;
    rate.parm.capture.timeperframe.denominator =
        static_cast<unsigned>(std::lround(kParts * settings_.fps));
    static_cast<void>(system_->ioctl(file_, VIDIOC_S_PARM, &rate));
  }

  void map_buffers() {
    auto request = zeroed<v4l2_requestbuffers>();
    request.count = kMappedBuffers;
    request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    request.memory = V4L2_MEMORY_MMAP;
    control("share its buffers", VIDIOC_REQBUFS, request);
    for (unsigned i = 0; i < request.count; ++i) {
      v4l2_buffer buffer = empty_buffer(i);
      control("share its buffers", VIDIOC_QUERYBUF, buffer);
      void* memory = system_->map(buffer.length, file_, buffer.m.offset);
      if (memory == nullptr) fail("cannot share its buffers");
      mapped_.push_back({memory, buffer.length});
    }
  }

  void start() {
    if (streaming_) return;
    for (unsigned i = 0; i < mapped_.size(); ++i) {
      v4l2_buffer buffer = empty_buffer(i);
      control("start", VIDIOC_QBUF, buffer);
    }
    int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    control("start", VIDIOC_STREAMON, type);
    streaming_ = true;
  }
  void stop() noexcept {
    if (!streaming_) return;
    int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    static_cast<void>(system_->ioctl(file_, VIDIOC_STREAMOFF, &type));
    streaming_ = false;
  }
  void close() noexcept {
    stop();
    for (const MappedBuffer& mapped : mapped_)
      system_->unmap(mapped.memory, mapped.length);
    mapped_.clear();
    restore_controls(*system_, file_, before_);
    system_->close(file_);
  }

  CapturedFrame frame_of(const v4l2_buffer& buffer, double stamp_s) {
    CapturedFrame captured;
    captured.settings.exposure_ms = exposure_ms_;
    captured.id = buffer.sequence;
    captured.timestamp_s = stamp_s;
    if (is_compressed()) {
      decompress(buffer, captured);
      return captured;
    }
    const std::size_t wanted =
        static_cast<std::size_t>(row_bytes_) * static_cast<std::size_t>(info_.height_px);
    if ((buffer.flags & V4L2_BUF_FLAG_ERROR) != 0 || buffer.bytesused < wanted) {
      captured.complete = false;
      captured.incomplete_cause = fmt::format("{} of {} bytes arrived", buffer.bytesused, wanted);
      return captured;
    }
    const std::size_t step =
        format_ == V4L2_PIX_FMT_GREY ? 1 : 2;  // YUYV: every other byte is luminance
    const auto* pixels = static_cast<const std::uint8_t*>(mapped_.at(buffer.index).memory);
    Image<std::uint8_t> image(info_.width_px, info_.height_px, Uninitialized{});
    for (int y = 0; y < info_.height_px; ++y) {
      const std::uint8_t* row =
          pixels + static_cast<std::size_t>(row_bytes_) * static_cast<std::size_t>(y);
      for (int x = 0; x < info_.width_px; ++x)
        image(x, y) = row[step * static_cast<std::size_t>(x)];
    }
    captured.frame = std::move(image);
    return captured;
  }

  void decompress(const v4l2_buffer& buffer, CapturedFrame& captured) {
    const MappedBuffer& mapped = mapped_.at(buffer.index);
    const auto* const bytes = static_cast<const std::uint8_t*>(mapped.memory);
    captured.complete = false;
    if ((buffer.flags & V4L2_BUF_FLAG_ERROR) != 0 || buffer.bytesused > mapped.length) {
      captured.incomplete_cause = fmt::format("{} bytes arrived damaged", buffer.bytesused);
      return;
    }
    try {
      MjpegFrame frame = decode_mjpeg({bytes, buffer.bytesused}, info_.width_px, info_.height_px);
      quality_ = frame.quality;
      captured.frame = std::move(frame.brightness);
    } catch (const Error& error) {
      captured.incomplete_cause = error.what();
      return;
    }
    constexpr int kTolerance = 5;
    captured.complete = quality_ + kTolerance >= info_.jpeg_quality.value_or(0);
    if (captured.complete) return;
    captured.incomplete_cause =
        fmt::format("its JPEG quality fell from {} to {}; use a smaller size",
                    info_.jpeg_quality.value_or(0),
                    quality_);
  }

  std::shared_ptr<V4l2System> system_;
  V4l2Settings settings_;
  std::string name_;
  CameraInfo info_;
  int file_;
  unsigned format_ = 0;
  unsigned row_bytes_ = 0;
  int quality_ = 0;  ///< of the last compressed frame
  double exposure_ms_ = 10.0;
  bool streaming_ = false;
  std::vector<MappedBuffer> mapped_;
  std::vector<V4l2Control> before_;  ///< as another program left them
  std::vector<std::string> warnings_;
};

}  // namespace

std::unique_ptr<CameraDevice> open_v4l2_camera(const V4l2Settings& settings,
                                               std::shared_ptr<V4l2System> system) {
  return std::make_unique<V4l2Camera>(settings, std::move(system));
}

}  // namespace frangia
