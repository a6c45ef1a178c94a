#include "frangia/devices/rig_devices.h"

#include <algorithm>
#include <array>
#include <exception>
#include <string>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "frangia/rig/rig.h"

namespace frangia {
namespace {

/// Casts a device to the class of its kind.
template <typename T>
void assign_as(std::unique_ptr<Device> device, std::unique_ptr<T>& place) {
  auto* as = dynamic_cast<T*>(device.get());
  if (as == nullptr)
    fail_device(*device, "the driver opened a device of another kind; choose another driver");
  static_cast<void>(device.release());
  place.reset(as);
}

/// `camera`: which one of the rig it is, if it is one.
void assign(std::unique_ptr<Device> device,
            DeviceKind kind,
            std::size_t camera,
            RigDevices& devices) {
  switch (kind) {
    case DeviceKind::Camera:
      return assign_as(std::move(device), devices.cameras[camera]);
    case DeviceKind::PhaseShifter:
      return assign_as(std::move(device), devices.shifter);
    case DeviceKind::PatternDisplay:
      return assign_as(std::move(device), devices.display);
    case DeviceKind::LaserSheet:
      return assign_as(std::move(device), devices.laser_sheet);
    case DeviceKind::Light:
      return assign_as(std::move(device), devices.light);
    case DeviceKind::Turntable:
      return assign_as(std::move(device), devices.turntable);
  }
}

[[noreturn]] void refuse_size(const std::filesystem::path& file,
                              const Device& device,
                              int width,
                              int height,
                              const std::string& key) {
  throw Error(ErrorKind::Input,
              fmt::format("{}: {} is not the {} x {} pixels of {}; correct the rig or the "
                          "device's region",
                          file.string(),
                          key,
                          width,
                          height,
                          device.name()));
}

/// `table` is that of the camera in rig.toml.
void check_camera(const std::filesystem::path& file,
                  const std::string& table,
                  const Camera& camera,
                  const CameraDevice& device) {
  const CameraInfo& info = device.info();
  if (info.width_px != camera.model.width_px || info.height_px != camera.model.height_px)
    refuse_size(file, device, info.width_px, info.height_px, table + ".size_px");
  // A sensor may saturate below the largest number; with half of it, the pixels have fewer bits.
  if (camera.white_level > info.white_level || 2 * camera.white_level <= info.white_level) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: {}.white_level is {}, but {} is saturated at {} or a little below",
                            file.string(),
                            table,
                            camera.white_level,
                            device.name(),
                            info.white_level));
  }
}

void check_sizes(const std::filesystem::path& file, const Rig& rig, const RigDevices& devices) {
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    if (!devices.cameras[i]) continue;
    check_camera(file,
                 i == 0 ? "camera" : fmt::format("more_cameras[{}]", i - 1),
                 rig.cameras[i].camera,
                 *devices.cameras[i]);
  }
  if (devices.display) {
    const DisplayInfo& info = devices.display->info();
    const auto* model = std::get_if<PinholeModel>(&rig.projector.model);
    const std::array<int, 2> image =
        model == nullptr ? std::array{0, 0}
                         : image_size(rig.projector.pixels, model->width_px, model->height_px);
    if (info.width_px != image[0] || info.height_px != image[1])
      refuse_size(file, *devices.display, info.width_px, info.height_px, "projector.size_px");
  }
  if (devices.shifter && !rig.projector.is_angular()) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: [devices.fringes] is a phase shifter, but "
                            "projector.model is \"pinhole\"",
                            file.string()));
  }
}

/// Adds the devices that exist, light first.
std::vector<Device*> devices_of(const RigDevices& rig) {
  std::vector<Device*> devices{rig.light.get(),
                               rig.laser_sheet.get(),
                               rig.display.get(),
                               rig.turntable.get(),
                               rig.shifter.get()};
  for (const auto& camera : rig.cameras)
    devices.push_back(camera.get());
  return devices;
}

/// Which camera of the rig a table of devices is of; 0 for tables of other devices.
std::size_t camera_of(const DeviceSettings& settings, const Rig& rig) {
  const std::string& table = settings.device();
  if (!table.starts_with(kFurtherCamera)) return 0;
  const std::string name = table.substr(kFurtherCamera.size());
  for (std::size_t i = 1; i < rig.cameras.size(); ++i) {
    if (rig.cameras[i].camera.name == name) return i;
  }
  settings.fail("driver",
                fmt::format("is of a camera \"{}\" that [[more_cameras]] does not have; add it, or "
                            "remove the device",
                            name));
}

}  // namespace

std::vector<Device*> RigDevices::all() const {
  std::vector<Device*> devices;
  for (Device* device : devices_of(*this))
    if (device != nullptr) devices.push_back(device);
  return devices;
}

void make_safe(std::span<Device* const> devices) noexcept {
  constexpr std::size_t kMost = 8;  // more than a rig has
  std::array<std::thread, kMost> threads;
  std::size_t running = 0;
  const auto is_display = [](Device* device) {
    return dynamic_cast<PatternDisplay*>(device) != nullptr;
  };
  for (Device* device : devices) {
    if (device == nullptr || is_display(device)) continue;
    try {
      std::thread& next = threads.at(running);  // throws before a thread is started
      next = std::thread([device] { device->make_safe(); });
      ++running;
    } catch (const std::exception&) {  // no further thread can be started
      device->make_safe();
    }
  }
  for (Device* device : devices)
    if (device != nullptr && is_display(device)) device->make_safe();
  for (std::size_t i = 0; i < running; ++i)
    threads.at(i).join();
}

// NOLINTNEXTLINE(readability-make-member-function-const): the devices are part of it
void RigDevices::make_safe() noexcept {
  frangia::make_safe(devices_of(*this));
}

// NOLINTNEXTLINE(readability-make-member-function-const): the devices are part of it
void RigDevices::make_dark() noexcept {
  std::vector<Device*> devices = devices_of(*this);
  if (turntable && turntable->angle_rad())
    std::replace(devices.begin(), devices.end(), static_cast<Device*>(turntable.get()), {});
  frangia::make_safe(devices);
}

void warn_of(Device& device, const Run& run) {
  for (const std::string& sentence : device.take_warnings())
    run.warn(fmt::format("{}: {}", device.name(), sentence));
}

RigDevices open_devices(const std::filesystem::path& rig_file,
                        const Rig& rig,
                        const std::vector<Driver>& drivers,
                        const Deadline& deadline,
                        const Run& run,
                        Guardian* guardian) {
  RigDevices devices;
  devices.cameras.resize(rig.cameras.size());
  for (DeviceSettings& settings : read_device_settings(rig_file)) {
    const Driver& driver = driver_for(settings, drivers);
    const std::size_t camera = camera_of(settings, rig);
    std::unique_ptr<Device> device =
        driver.open(settings, camera == 0 ? rig : rig_of_camera(rig, camera), deadline);
    if (driver.kind == DeviceKind::Camera && camera == 0)
      devices.exposure_step_ms = settings.number_or("exposure_step_ms", 0.0, 0.0, 1000.0);
    settings.warn_of_unused_keys(run);
    warn_of(*device, run);
    if (const auto how = device->safe_off(); how && guardian != nullptr)
      devices.watches.push_back(guardian->watch(*how));
    assign(std::move(device), driver.kind, camera, devices);
    devices.settings.push_back(settings);
  }
  check_sizes(rig_file, rig, devices);
  return devices;
}

}  // namespace frangia
