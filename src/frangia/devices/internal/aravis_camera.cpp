#ifdef FRANGIA_WITH_ARAVIS

#include "frangia/devices/internal/aravis_camera.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <utility>

#include <arv.h>
#include <fmt/format.h>
#include <glib-object.h>

namespace frangia {
namespace {

/// Gives up one reference to a GObject.
struct Unref {
  void operator()(gpointer object) const { g_object_unref(object); }
};

/// Owns one reference to a GObject.
template <typename T>
using Ref = std::unique_ptr<T, Unref>;

/// Owns a GError.
class GlibError {
 public:
  GlibError() = default;
  GlibError(const GlibError&) = delete;
  GlibError& operator=(const GlibError&) = delete;
  GlibError(GlibError&&) = delete;
  GlibError& operator=(GlibError&&) = delete;
  ~GlibError() { g_clear_error(&error_); }

  /// Where a function of GLib stores an error; an earlier one is dropped.
  [[nodiscard]] GError** out() {
    g_clear_error(&error_);
    return &error_;
  }
  explicit operator bool() const { return error_ != nullptr; }
  [[nodiscard]] std::string text() const { return error_ != nullptr ? error_->message : ""; }

 private:
  GError* error_ = nullptr;
};

constexpr int kBuffers = 3;
/// Time limit for a frame after its exposure; all packets of a frame may be lost.
constexpr double kLateFrame_s = 1.0;

std::string text_of(const char* text, const char* otherwise) {
  return text != nullptr ? text : otherwise;
}

int white_level_of(const std::string& pixel_format) {
  return (1 << std::stoi(pixel_format.substr(std::strlen("Mono")))) - 1;
}

const char* cause_of(ArvBufferStatus status) {
  switch (status) {
    case ARV_BUFFER_STATUS_TIMEOUT:
      return "its last packets did not arrive in time";
    case ARV_BUFFER_STATUS_MISSING_PACKETS:
      return "some of its packets were lost";
    case ARV_BUFFER_STATUS_WRONG_PACKET_ID:
      return "its packet numbers are wrong";
    case ARV_BUFFER_STATUS_SIZE_MISMATCH:
      return "it is larger than the stated size";
    default:
      return "its transfer was aborted";
  }
}

template <typename T>
Image<T> copy_pixels(const CameraInfo& info, const void* data) {
  Image<T> image(info.width_px, info.height_px, Uninitialized{});
  std::memcpy(image.pixels().data(), data, image.pixels().size_bytes());
  return image;
}

/// Copies the pixels of a complete buffer, its number and its time.
void take_pixels(ArvBuffer& buffer, const CameraInfo& info, CapturedFrame& captured) {
  std::size_t size = 0;
  const void* data = arv_buffer_get_data(&buffer, &size);
  const std::size_t bytes = info.white_level > 255 ? 2 : 1;
  const auto pixels =
      static_cast<std::size_t>(info.width_px) * static_cast<std::size_t>(info.height_px);
  if (arv_buffer_get_image_width(&buffer) != info.width_px ||
      arv_buffer_get_image_height(&buffer) != info.height_px || size < pixels * bytes) {
    captured.incomplete_cause = "its size differs from that of the camera";
    return;
  }
  if (bytes == 1) {
    captured.frame = copy_pixels<std::uint8_t>(info, data);
  } else {
    captured.frame = copy_pixels<std::uint16_t>(info, data);
  }
  captured.complete = true;
  captured.id = arv_buffer_get_frame_id(&buffer);
  captured.timestamp_s = 1e-9 * static_cast<double>(arv_buffer_get_timestamp(&buffer));
}

class AravisCamera final : public CameraDevice {
 public:
  AravisCamera(const AravisSettings& settings, const Deadline& deadline) {
    GlibError fault;
    const char* id = settings.id.empty() ? nullptr : settings.id.c_str();
    name_ = settings.id.empty() ? "camera" : "camera " + settings.id;
    camera_.reset(arv_camera_new(id, fault.out()));
    if (!camera_) {
      fail(fmt::format("cannot be opened ({}); run 'frangia devices' to list the cameras",
                       fault.text()));
    }
    const char* serial = arv_camera_get_device_serial_number(camera_.get(), fault.out());
    const char* model = arv_camera_get_model_name(camera_.get(), fault.out());
    name_ = fmt::format("camera {} {}", text_of(model, ""), text_of(serial, ""));
    deadline.check();
    prepare(settings);
    g_signal_connect(arv_camera_get_device(camera_.get()),
                     "control-lost",
                     G_CALLBACK(AravisCamera::on_control_lost),
                     this);
    start_stream();
  }
  AravisCamera(const AravisCamera&) = delete;
  AravisCamera& operator=(const AravisCamera&) = delete;
  AravisCamera(AravisCamera&&) = delete;
  AravisCamera& operator=(AravisCamera&&) = delete;
  ~AravisCamera() override {
    if (camera_) {
      g_signal_handlers_disconnect_by_data(arv_camera_get_device(camera_.get()), this);
    }
    make_safe();
  }

  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] const CameraInfo& info() const override { return info_; }

  [[nodiscard]] std::string test(const Deadline& /*deadline*/) override {
    GlibError fault;
    const double exposure_us = arv_camera_get_exposure_time(camera_.get(), fault.out());
    check("report its exposure", fault);
    return fmt::format("{} x {} pixels, white at {}, exposure {:.3g} ms",
                       info_.width_px,
                       info_.height_px,
                       info_.white_level,
                       exposure_us / 1000.0);
  }

  void make_safe() noexcept override {
    if (camera_ && streaming_) arv_camera_stop_acquisition(camera_.get(), nullptr);
    streaming_ = false;
  }

  CameraSettings configure(const CameraSettings& settings, const Deadline& deadline) override {
    deadline.check();
    check_exposure(settings.exposure_ms);
    GlibError fault;
    arv_camera_set_exposure_time(camera_.get(), 1000.0 * settings.exposure_ms, fault.out());
    check("set its exposure", fault);
    if (has_gain_) {
      const double gain = std::clamp(settings.gain_db, min_gain_db_, info_.max_gain_db);
      arv_camera_set_gain(camera_.get(), gain, fault.out());
      check("set its gain", fault);
    } else if (settings.gain_db != 0.0) {
      fail("its gain cannot be set; leave it at 0 dB");
    }
    if (has_black_level_) {
      arv_camera_set_black_level(camera_.get(), settings.black_level_counts, fault.out());
      check("set its black level", fault);
    } else if (settings.black_level_counts != 0.0) {
      fail("its black level cannot be set; leave it at 0");
    }
    read_back();
    return settings_;
  }

  [[nodiscard]] CapturedFrame capture(const FrameLabel& /*label*/,
                                      const Deadline& deadline) override {
    if (!streaming_) start_acquisition();
    discard_old_frames();
    GlibError fault;
    arv_camera_software_trigger(camera_.get(), fault.out());
    check("trigger a frame", fault);
    const Deadline late = deadline.at_most(settings_.exposure_ms / 1000.0 + kLateFrame_s);
    while (!late.passed()) {
      deadline.check();
      if (control_lost_) fail_lost();
      constexpr guint64 kPiece_us = 20'000;
      Ref<ArvBuffer> buffer(arv_stream_timeout_pop_buffer(stream_.get(), kPiece_us));
      if (buffer) return frame_of(std::move(buffer));
    }
    if (deadline.passed()) {
      fail(fmt::format("no frame within {:.3g} s; check its cable and the firewall",
                       deadline.timeout_s));
    }
    return incomplete("none of its packets arrived");
  }

 private:
  static void on_control_lost(ArvDevice* /*device*/, gpointer self) {
    static_cast<AravisCamera*>(self)->control_lost_ = true;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorKind::Device, name_ + ": " + what);
  }
  [[noreturn]] void fail_lost() const {
    fail("control was lost; check that it is plugged in and no other program uses it");
  }
  void check(const char* what, const GlibError& fault) const {
    if (control_lost_) fail_lost();
    if (fault) fail(fmt::format("cannot {} ({})", what, fault.text()));
  }

  void prepare(const AravisSettings& settings) {
    GlibError fault;
    ArvCamera* camera = camera_.get();
    arv_camera_stop_acquisition(camera, fault.out());  // the previous user may have left it running
    arv_camera_set_pixel_format_from_string(camera, settings.pixel_format.c_str(), fault.out());
    check(("set the pixel format " + settings.pixel_format).c_str(), fault);
    auto [x, y, width, height] = settings.region_px;
    if (width == 0 || height == 0) {
      arv_camera_get_sensor_size(camera, &width, &height, fault.out());
      check("report its size", fault);
    }
    arv_camera_set_region(camera, x, y, width, height, fault.out());
    check(fmt::format("set the region {} x {} at {}, {}", width, height, x, y).c_str(), fault);
    arv_camera_get_region(camera, &x, &y, &info_.width_px, &info_.height_px, fault.out());
    check("report its region", fault);
    info_.white_level = white_level_of(settings.pixel_format);
    arv_camera_set_trigger(camera, "Software", fault.out());
    check("use the software trigger", fault);
    read_ranges();
    read_back();
  }

  void read_ranges() {
    GlibError fault;
    ArvCamera* camera = camera_.get();
    double least_us = 0.0;
    double most_us = 0.0;
    arv_camera_get_exposure_time_bounds(camera, &least_us, &most_us, fault.out());
    check("report its exposure range", fault);
    info_.min_exposure_ms = least_us / 1000.0;
    info_.max_exposure_ms = most_us / 1000.0;
    has_gain_ = arv_camera_is_gain_available(camera, fault.out()) != FALSE;
    if (has_gain_)
      arv_camera_get_gain_bounds(camera, &min_gain_db_, &info_.max_gain_db, fault.out());
    has_black_level_ = arv_camera_is_black_level_available(camera, fault.out()) != FALSE;
  }

  void read_back() {
    GlibError fault;
    settings_.exposure_ms = arv_camera_get_exposure_time(camera_.get(), fault.out()) / 1000.0;
    check("report its exposure", fault);
    if (has_gain_) settings_.gain_db = arv_camera_get_gain(camera_.get(), fault.out());
    if (has_black_level_) {
      settings_.black_level_counts = arv_camera_get_black_level(camera_.get(), fault.out());
    }
  }

  void start_stream() {
    GlibError fault;
    stream_.reset(arv_camera_create_stream(camera_.get(), nullptr, nullptr, fault.out()));
    if (!stream_) fail(fmt::format("has no stream ({})", fault.text()));
    const guint payload = arv_camera_get_payload(camera_.get(), fault.out());
    check("report the size of its frames", fault);
    for (int i = 0; i < kBuffers; ++i)
      arv_stream_push_buffer(stream_.get(), arv_buffer_new(payload, nullptr));
    start_acquisition();
  }

  void start_acquisition() {
    GlibError fault;
    arv_camera_start_acquisition(camera_.get(), fault.out());
    check("start", fault);
    streaming_ = true;
  }

  /// Whether a frame was exposed before the trigger.
  void discard_old_frames() {
    while (ArvBuffer* old = arv_stream_try_pop_buffer(stream_.get()))
      arv_stream_push_buffer(stream_.get(), old);
  }

  CapturedFrame frame_of(Ref<ArvBuffer> buffer) {
    CapturedFrame captured = incomplete("");
    const ArvBufferStatus status = arv_buffer_get_status(buffer.get());
    // The width of a failed buffer must not be queried.
    if (status != ARV_BUFFER_STATUS_SUCCESS) {
      captured.incomplete_cause = cause_of(status);
    } else {
      take_pixels(*buffer, info_, captured);
    }
    arv_stream_push_buffer(stream_.get(), buffer.release());
    return captured;
  }

  [[nodiscard]] CapturedFrame incomplete(const std::string& cause) const {
    CapturedFrame captured;
    captured.settings = settings_;
    captured.complete = false;
    captured.incomplete_cause = cause;
    return captured;
  }

  std::string name_;
  CameraInfo info_;
  CameraSettings settings_;
  Ref<ArvCamera> camera_;
  Ref<ArvStream> stream_;
  double min_gain_db_ = 0.0;
  bool has_gain_ = false;
  bool has_black_level_ = false;
  bool streaming_ = false;
  std::atomic<bool> control_lost_ = false;
};

}  // namespace

std::unique_ptr<CameraDevice> open_aravis_camera(const AravisSettings& settings,
                                                 const Deadline& deadline) {
  return std::make_unique<AravisCamera>(settings, deadline);
}

std::vector<FoundDevice> find_aravis_cameras(const Deadline& /*deadline*/) {
  std::vector<FoundDevice> found;
  arv_update_device_list();
  for (unsigned i = 0; i < arv_get_n_devices(); ++i) {
    const char* id = arv_get_device_id(i);
    const char* model = arv_get_device_model(i);
    const char* address = arv_get_device_address(i);
    found.push_back({fmt::format("{} at {}", text_of(model, "camera"), text_of(address, "?")),
                     fmt::format("driver = \"aravis\"\nid = \"{}\"\n", text_of(id, ""))});
  }
  return found;
}

}  // namespace frangia

#endif
