#include "frangia/acquisition/capture_scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/acquisition/internal/capture_devices.h"
#include "frangia/acquisition/internal/capture_folder.h"
#include "frangia/acquisition/internal/capture_session.h"
#include "frangia/core/angles.h"
#include "frangia/devices/device_settings.h"
#include "frangia/frames/jpeg_noise.h"

namespace frangia {
namespace {

/// Keys that may change between sessions: the operating system may renumber ports and monitors
/// after a restart, and a user who resumes after a fault may have slowed the table down or given it
/// more time to home. docs/devices.md lists all keys.
constexpr std::array<std::string_view, 23> kMayChange = {"port",
                                                         "baud",
                                                         "parity",
                                                         "stop_bits",
                                                         "host",
                                                         "tcp_port",
                                                         "path",
                                                         "monitor",
                                                         "boot_s",
                                                         "settle_s",
                                                         "delay_s",
                                                         "speed_deg_per_s",
                                                         "min_deg",
                                                         "max_deg",
                                                         "start_deg",
                                                         "faults",
                                                         "real_time",
                                                         "skip_frames",
                                                         "gpib_address",
                                                         "identify",
                                                         "end",
                                                         "home_time_s",
                                                         "exposure_step_ms"};

std::string text_of_value(const SettingValue& value) {
  return std::visit([](const auto& held) { return fmt::format("{}", held); }, value);
}

/// Describes the devices of a rig for comparison between the sessions of a scan, one setting per
/// line: "[camera]", "part = plate", ... Settings that state only how a device is reached, how fast
/// it is or which faults are simulated may change between sessions and are left out.
std::string describe_devices(const std::vector<DeviceSettings>& devices) {
  std::string text;
  for (const DeviceSettings& device : devices) {
    text += fmt::format("[{}]\n", device.device());
    for (const auto& [key, value] : device.values()) {
      if (std::find(kMayChange.begin(), kMayChange.end(), key) == kMayChange.end())
        text += fmt::format("{} = {}\n", key, text_of_value(value));
    }
  }
  return text;
}

/// The options that must not change between the sessions of one scan, in words.
std::string describe(const CaptureOptions& options) {
  static constexpr std::array kChoices = {"given", "automatic", "bracketed"};
  return fmt::format(
      "exposure = {} {} ms\ngain = {} dB\nblack level = {} counts\nsteps controlled = {}\n",
      kChoices.at(static_cast<std::size_t>(options.exposure)),
      options.camera.exposure_ms,
      options.camera.gain_db,
      options.camera.black_level_counts,
      options.control_steps);
}

void amplify(Camera& camera, double gain) {
  if (!camera.noise) return;
  NoiseModel& noise = *camera.noise;
  constexpr double kRounding_counts2 = 1.0 / 12.0;
  noise.slope_counts *= gain;
  noise.floor_counts2 = (noise.floor_counts2 - kRounding_counts2) * gain * gain + kRounding_counts2;
}

/// The plan with the noise models at a gain of the cameras: noise in counts grows with the gain.
Scan with_gain(Scan plan, double gain_db) {
  if (gain_db == 0.0) return plan;
  const double gain = std::pow(10.0, gain_db / 20.0);
  for (PosedCamera& posed : plan.rig.cameras)
    amplify(posed.camera, gain);
  return plan;
}

/// Counts the noise of a camera that compresses its frames.
void count_compression(const CameraInfo& camera, Scan& plan, const Run& run) {
  if (!camera.jpeg_quality) return;
  plan.frames.compression_counts2 = jpeg_noise_counts2(*camera.jpeg_quality);
  run.warn(
      fmt::format("the camera delivers JPEGs of quality {}: the compression adds noise of {:.2g} "
                  "counts to each pixel, and sigma counts it; a camera with a grey or YUYV format, "
                  "or a smaller size, gives the full accuracy",
                  *camera.jpeg_quality,
                  std::sqrt(plan.frames.compression_counts2)));
}

}  // namespace

std::string SkippedView::sentence() const {
  return fmt::format("view {} at {:.6g} degrees: {}", view + 1, deg_from_rad(angle_rad), reason);
}

CaptureReport capture_scan(const Scan& plan,
                           RigDevices& devices,
                           const CaptureOptions& options,
                           const Run& run) {
  return capture_scan(plan, devices, FolderLock(plan.folder), options, run);
}

CaptureReport capture_scan(const Scan& plan,
                           RigDevices& devices,
                           const FolderLock& lock,
                           const CaptureOptions& options,
                           const Run& run) {
  require(!plan.patterns.empty() && !plan.views.empty(),
          "a scan needs at least one pattern and one view; add them to the plan");
  require(std::any_of(plan.views.begin(),
                      plan.views.end(),
                      [&](const ScanView& view) { return view.setup == options.setup; }),
          "the plan has no view of this `setup`");
  std::error_code ignored;
  require(std::filesystem::equivalent(plan.folder, lock.folder(), ignored),
          "the lock is that of another folder; lock the folder of the plan");
  const SafeStateGuard safe(devices);
  check_devices(devices, plan, options);
  Scan real = with_gain(plan, options.camera.gain_db);
  count_compression(devices.reference()->info(), real, run);
  claim_folder(real, {describe(options), describe_devices(devices.settings)}, run);
  return CaptureSession(std::move(real), devices, options, run).capture();
}

}  // namespace frangia
