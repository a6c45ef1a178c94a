#include "frangia/devices/internal/v4l2_modes.h"

#include <algorithm>
#include <cstring>
#include <tuple>

#include <fmt/format.h>
#include <linux/videodev2.h>

namespace frangia {
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

}  // namespace frangia
