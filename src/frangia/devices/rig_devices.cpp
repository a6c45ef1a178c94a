#include "frangia/devices/rig_devices.h"

#include <algorithm>
#include <array>
#include <exception>
#include <thread>
#include <utility>

#include <fmt/format.h>

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

void assign(std::unique_ptr<Device> device, DeviceKind kind, RigDevices& devices) {
  switch (kind) {
    case DeviceKind::Camera:
      return assign_as(std::move(device), devices.camera);
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

void check_sizes(const std::filesystem::path& file, const Rig& rig, const RigDevices& devices) {
  const auto refuse = [&](const Device& device, int width, int height, const std::string& key) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: {} is not the {} x {} pixels of {}; correct the rig or the "
                            "device's region",
                            file.string(),
                            key,
                            width,
                            height,
                            device.name()));
  };
  if (devices.camera) {
    const CameraInfo& info = devices.camera->info();
    const CameraModel& model = rig.camera.model;
    if (info.width_px != model.width_px || info.height_px != model.height_px)
      refuse(*devices.camera, info.width_px, info.height_px, "camera.size_px");
    if (info.white_level != rig.camera.white_level) {
      throw Error(ErrorKind::Input,
                  fmt::format("{}: camera.white_level is {}, but {} is saturated at {}",
                              file.string(),
                              rig.camera.white_level,
                              devices.camera->name(),
                              info.white_level));
    }
  }
  if (devices.display) {
    const DisplayInfo& info = devices.display->info();
    const auto* model = std::get_if<PinholeModel>(&rig.projector.model);
    const std::array<int, 2> image =
        model == nullptr ? std::array{0, 0}
                         : image_size(rig.projector.pixels, model->width_px, model->height_px);
    if (info.width_px != image[0] || info.height_px != image[1])
      refuse(*devices.display, info.width_px, info.height_px, "projector.size_px");
  }
  if (devices.shifter && !rig.projector.is_angular()) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: [devices.fringes] is a phase shifter, but "
                            "projector.model is \"pinhole\"",
                            file.string()));
  }
}

/// Adds the devices that exist, light first.
std::array<Device*, 6> devices_of(const RigDevices& rig) {
  return {rig.light.get(),
          rig.laser_sheet.get(),
          rig.display.get(),
          rig.turntable.get(),
          rig.shifter.get(),
          rig.camera.get()};
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
  std::array<Device*, 6> devices = devices_of(*this);
  if (turntable && turntable->angle_rad())
    std::replace(devices.begin(), devices.end(), static_cast<Device*>(turntable.get()), {});
  frangia::make_safe(devices);
}

RigDevices open_devices(const std::filesystem::path& rig_file,
                        const Rig& rig,
                        const std::vector<Driver>& drivers,
                        const Deadline& deadline,
                        const Run& run,
                        Guardian* guardian) {
  RigDevices devices;
  for (DeviceSettings& settings : read_device_settings(rig_file)) {
    const Driver& driver = driver_for(settings, drivers);
    std::unique_ptr<Device> device = driver.open(settings, rig, deadline);
    settings.warn_of_unused_keys(run);
    if (const auto how = device->safe_off(); how && guardian != nullptr)
      devices.watches.push_back(guardian->watch(*how));
    assign(std::move(device), driver.kind, devices);
    devices.settings.push_back(settings);
  }
  check_sizes(rig_file, rig, devices);
  return devices;
}

}  // namespace frangia
