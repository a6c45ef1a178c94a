#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/devices/camera_device.h"
#include "frangia/devices/internal/own_drivers.h"
#include "frangia/frames/png.h"

namespace frangia {
namespace {

std::vector<std::filesystem::path> sorted_entries(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> entries;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none))
    entries.push_back(entry.path());
  std::sort(entries.begin(), entries.end());
  return entries;
}

/// The view folders of a scan and its first frame.
std::vector<std::filesystem::path> views_of(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> views;
  for (const auto& entry : sorted_entries(folder / "views"))
    if (std::filesystem::is_directory(entry)) views.push_back(entry);
  return views;
}

std::filesystem::path first_frame(const std::vector<std::filesystem::path>& views) {
  for (const auto& view : views) {
    for (const auto& file : sorted_entries(view))
      if (file.extension() == ".png") return file;
  }
  return {};
}

class FolderCamera final : public CameraDevice {
 public:
  FolderCamera(DeviceSettings& settings, const Rig& rig)
      : folder_(settings.path("folder")), views_(views_of(folder_)) {
    const std::filesystem::path first = first_frame(views_);
    if (first.empty()) {
      settings.fail(
          "folder",
          fmt::format("is \"{}\", but it contains no frame such as views/000/fringe-0.png; "
                      "name a scan folder",
                      folder_.string()));
    }
    const Frame frame = read_png(first);
    info_.width_px = width_of(frame);
    info_.height_px = height_of(frame);
    info_.white_level = rig.reference().white_level;
    info_.min_exposure_ms = 0.0;
    info_.max_exposure_ms = 1e9;
    info_.max_gain_db = 1e3;
  }

  [[nodiscard]] std::string name() const override { return "folder camera " + folder_.string(); }
  [[nodiscard]] const CameraInfo& info() const override { return info_; }
  [[nodiscard]] std::string test(const Deadline& /*deadline*/) override {
    return fmt::format(
        "{} views of {} x {} pixels", views_.size(), info_.width_px, info_.height_px);
  }
  void make_safe() noexcept override {}
  CameraSettings configure(const CameraSettings& settings, const Deadline& /*deadline*/) override {
    return settings_ = settings;
  }

  [[nodiscard]] CapturedFrame capture(const FrameLabel& label, const Deadline& deadline) override {
    deadline.check();
    const auto view = static_cast<std::size_t>(label.view);
    if (view >= views_.size()) {
      fail_device(*this,
                  fmt::format("has {} views; set `views` to no more than that", views_.size()));
    }
    const auto bracketed =
        views_[view] / fmt::format("{}-{}@{}.png", label.pattern, label.frame, label.exposure);
    const auto plain = views_[view] / fmt::format("{}-{}.png", label.pattern, label.frame);
    const auto& file = std::filesystem::exists(bracketed) ? bracketed : plain;
    if (!std::filesystem::exists(file)) {
      fail_device(
          *this,
          fmt::format("{} is missing; add it, or use the patterns that exist", file.string()));
    }
    CapturedFrame captured;
    captured.frame = read_png(file);
    captured.settings = settings_;
    captured.id = ++count_;
    return captured;
  }

 private:
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> views_;
  CameraInfo info_;
  CameraSettings settings_;
  std::uint64_t count_ = 0;
};

}  // namespace

Driver folder_camera_driver() {
  Driver driver;
  driver.name = "folder";
  driver.kind = DeviceKind::Camera;
  driver.description = "replays the frames of a scan folder";
  driver.open =
      [](DeviceSettings& settings, const Rig& rig, const Deadline&) -> std::unique_ptr<Device> {
    return std::make_unique<FolderCamera>(settings, rig);
  };
  return driver;
}

}  // namespace frangia
