#include "frangia/devices/internal/v4l2_system.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <system_error>
#include <tuple>

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/videodev2.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace frangia {
namespace {

class KernelV4l2 final : public V4l2System {
 public:
  [[nodiscard]] int open(const char* path) override {
    return ::open(path, O_RDWR | O_NONBLOCK | O_CLOEXEC);  // NOLINT(*-vararg)
  }
  void close(int file) override { ::close(file); }
  [[nodiscard]] int ioctl(int file, unsigned long request, void* argument) override {
    return ::ioctl(file, request, argument);  // NOLINT(*-vararg)
  }
  [[nodiscard]] void* map(std::size_t length, int file, std::size_t offset) override {
    void* memory = ::mmap(
        nullptr, length, PROT_READ | PROT_WRITE, MAP_SHARED, file, static_cast<::off_t>(offset));
    return memory == MAP_FAILED ? nullptr : memory;  // NOLINT: cast in the macro
  }
  void unmap(void* memory, std::size_t length) override { ::munmap(memory, length); }
  [[nodiscard]] int wait_readable(int file, int milliseconds) override {
    ::pollfd wanted{file, POLLIN, 0};
    return ::poll(&wanted, 1, milliseconds);
  }
  [[nodiscard]] double now_s() override {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
  }
};

}  // namespace

std::shared_ptr<V4l2System> kernel_v4l2() {
  return std::make_shared<KernelV4l2>();
}

namespace {

constexpr unsigned kMostEntries = 64;  // of a list; a faulty driver lists without an end

/// Images per second of one format and size; a 0 where the camera does not say.
std::vector<double> rates(V4l2System& system, int file, unsigned format, int width, int height) {
  std::vector<double> found;
  for (unsigned i = 0; i < kMostEntries; ++i) {
    v4l2_frmivalenum entry;
    std::memset(&entry, 0, sizeof entry);
    entry.index = i;
    entry.pixel_format = format;
    entry.width = static_cast<unsigned>(width);
    entry.height = static_cast<unsigned>(height);
    if (system.ioctl(file, VIDIOC_ENUM_FRAMEINTERVALS, &entry) < 0) break;
    const v4l2_fract& shortest =
        entry.type == V4L2_FRMIVAL_TYPE_DISCRETE ? entry.discrete : entry.stepwise.min;
    if (shortest.numerator > 0)
      found.push_back(static_cast<double>(shortest.denominator) / shortest.numerator);
    if (entry.type != V4L2_FRMIVAL_TYPE_DISCRETE) break;
  }
  if (found.empty()) found.push_back(0.0);
  return found;
}

void add_sizes(V4l2System& system, int file, const V4l2Format& format, std::vector<V4l2Mode>& out) {
  for (unsigned i = 0; i < kMostEntries; ++i) {
    v4l2_frmsizeenum entry;
    std::memset(&entry, 0, sizeof entry);
    entry.index = i;
    entry.pixel_format = format.code;
    if (system.ioctl(file, VIDIOC_ENUM_FRAMESIZES, &entry) < 0) return;
    const bool listed = entry.type == V4L2_FRMSIZE_TYPE_DISCRETE;
    const auto width = static_cast<int>(listed ? entry.discrete.width : entry.stepwise.max_width);
    const auto height =
        static_cast<int>(listed ? entry.discrete.height : entry.stepwise.max_height);
    for (const double fps : rates(system, file, format.code, width, height))
      out.push_back({format, width, height, fps});
    if (!listed) return;
  }
}

}  // namespace

const std::vector<V4l2Format>& v4l2_formats() {
  static const std::vector<V4l2Format> kAll{{"grey", V4L2_PIX_FMT_GREY, "grey"},
                                            {"yuyv", V4L2_PIX_FMT_YUYV, "YUYV"},
                                            {"mjpeg", V4L2_PIX_FMT_MJPEG, "Motion JPEG"},
                                            {"jpeg", V4L2_PIX_FMT_JPEG, "JPEG"}};
  return kAll;
}

std::vector<V4l2Mode> v4l2_modes(V4l2System& system, int file) {
  std::vector<V4l2Mode> all;
  for (const V4l2Format& format : v4l2_formats()) {
    std::vector<V4l2Mode> own;
    add_sizes(system, file, format, own);
    std::stable_sort(own.begin(), own.end(), [](const V4l2Mode& a, const V4l2Mode& b) {
      return std::tuple(a.width_px * a.height_px, a.fps) >
             std::tuple(b.width_px * b.height_px, b.fps);
    });
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

std::vector<DeviceMode> device_modes(const std::vector<V4l2Mode>& modes) {
  std::vector<DeviceMode> out;
  for (const V4l2Mode& mode : modes) {
    DeviceMode& one = out.emplace_back();
    one.name = fmt::format("{} x {} pixels, {}", mode.width_px, mode.height_px, mode.format.people);
    one.settings = fmt::format("size_px = [{}, {}]\npixel_format = \"{}\"\n",
                               mode.width_px,
                               mode.height_px,
                               mode.format.name);
    if (mode.fps <= 0.0) continue;
    one.name += fmt::format(", {:.3g} /s", mode.fps);
    one.settings += fmt::format("frames_per_s = {:.6g}\n", mode.fps);
  }
  return out;
}

namespace {

/// An automatic function.
struct Automatic {
  std::uint32_t id;
  int off;  ///< its value without the function
  const char* what;
  const char* effect;  ///< when it stays on
};

constexpr std::array<Automatic, 7> kAutomatics{{
    {V4L2_CID_EXPOSURE_AUTO,
     V4L2_EXPOSURE_MANUAL,
     "automatic exposure",
     "the brightness of frames changes with the pattern"},
    {V4L2_CID_EXPOSURE_AUTO_PRIORITY,
     0,
     "priority of the exposure over the frame rate",
     "frames may be exposed longer than asked for"},
    {V4L2_CID_AUTOGAIN, 0, "automatic gain", "the brightness of frames changes with the pattern"},
    {V4L2_CID_AUTO_WHITE_BALANCE,
     0,
     "automatic white balance",
     "the brightness of frames changes with the pattern"},
    {V4L2_CID_FOCUS_AUTO, 0, "autofocus", "the focus and with it the calibration changes"},
    {V4L2_CID_BACKLIGHT_COMPENSATION,
     0,
     "backlight compensation",
     "the brightness of a pixel depends on the others"},
    {V4L2_CID_POWER_LINE_FREQUENCY,
     V4L2_CID_POWER_LINE_FREQUENCY_DISABLED,
     "filter against the flicker of lamps",
     "exposures are rounded to periods of the mains"},
}};

bool set_control(V4l2System& system, int file, const V4l2Control& control) {
  v4l2_control setting{control.id, control.value};
  return system.ioctl(file, VIDIOC_S_CTRL, &setting) >= 0;
}

/// Whether the camera has the control and it is in use.
bool has_control(V4l2System& system, int file, std::uint32_t id) {
  v4l2_queryctrl query;
  std::memset(&query, 0, sizeof query);
  query.id = id;
  return system.ioctl(file, VIDIOC_QUERYCTRL, &query) >= 0 &&
         (query.flags & V4L2_CTRL_FLAG_DISABLED) == 0;
}

}  // namespace

bool get_control(V4l2System& system, int file, V4l2Control& control) {
  v4l2_control setting{control.id, 0};
  if (system.ioctl(file, VIDIOC_G_CTRL, &setting) < 0) return false;
  control.value = setting.value;
  return true;
}

V4l2Automatics switch_off_automatics(V4l2System& system, int file) {
  V4l2Automatics done;
  for (const Automatic& automatic : kAutomatics) {
    if (!has_control(system, file, automatic.id)) continue;
    V4l2Control before{automatic.id, 0};
    const bool known = get_control(system, file, before);
    if (known && before.value == automatic.off) continue;
    const bool set = set_control(system, file, {automatic.id, automatic.off});
    const std::string cause = set ? "it keeps its value" : std::generic_category().message(errno);
    V4l2Control after{automatic.id, automatic.off};
    if (!set || (get_control(system, file, after) && after.value != automatic.off)) {
      done.warnings.push_back(fmt::format(
          "its {} cannot be switched off ({}): {}", automatic.what, cause, automatic.effect));
      continue;
    }
    if (automatic.id == V4L2_CID_FOCUS_AUTO) {
      // Switched on again, it would move the focus between the calibration and the scan.
      done.warnings.emplace_back(
          "its autofocus was on and is now off, also after the scan; calibrate it with this focus");
    } else if (known) {
      done.before.push_back(before);
    }
  }
  return done;
}

void restore_controls(V4l2System& system,
                      int file,
                      const std::vector<V4l2Control>& before) noexcept {
  for (auto control = before.rbegin(); control != before.rend(); ++control)
    static_cast<void>(set_control(system, file, *control));
}

}  // namespace frangia
