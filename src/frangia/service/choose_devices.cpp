#include "frangia/service/choose_devices.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/core/missing.h"
#include "frangia/devices/device_settings.h"
#include "frangia/devices/device_table.h"
#include "frangia/devices/rig_devices.h"
#include "frangia/rig/read_rig.h"
#include "frangia/rig/write_rig.h"
#include "frangia/service/rig_history.h"

namespace frangia {
namespace {

struct Sizes {
  CameraInfo camera;
  std::optional<DisplayInfo> display;
};

template <typename T>
const T& as(const Device& device) {
  const T* cast = dynamic_cast<const T*>(&device);
  if (cast == nullptr) fail_device(device, "is a device of another kind; choose another driver");
  return *cast;
}

/// Opens the camera and the display, one after the other, and reads their sizes.
Sizes sizes_of(std::vector<DeviceSettings>& devices,
               const Rig& rig,
               const std::vector<Driver>& drivers,
               Guardian* guardian,
               const Run& run) {
  constexpr double kTimeout_s = 10.0;
  Sizes sizes;
  for (DeviceSettings& settings : devices) {
    const Driver& driver = driver_for(settings, drivers);
    if (driver.kind != DeviceKind::Camera && driver.kind != DeviceKind::PatternDisplay) continue;
    const auto device = driver.open(settings, rig, Deadline::in(kTimeout_s, run.stop));
    std::optional<Guardian::Watch> watch;
    if (const auto how = device->safe_off(); how && guardian != nullptr)
      watch.emplace(guardian->watch(*how));
    if (driver.kind == DeviceKind::Camera) sizes.camera = as<CameraDevice>(*device).info();
    if (driver.kind == DeviceKind::PatternDisplay)
      sizes.display = as<PatternDisplay>(*device).info();
    device->make_safe();
  }
  return sizes;
}

/// The rig that a project has; empty without one.
std::optional<Rig> known_rig(const ProjectFolder& project, RigContent content) {
  std::error_code ignored;
  if (!std::filesystem::exists(project.rig(), ignored)) return std::nullopt;
  try {
    return read_rig(project.rig(), {}, content);
  } catch (const Error&) {
    if (content == RigContent::Complete) return std::nullopt;  // it is not calibrated
    throw;
  }
}

Rig with_sizes(Rig rig, const Sizes& sizes) {
  rig.reference().model.width_px = sizes.camera.width_px;
  rig.reference().model.height_px = sizes.camera.height_px;
  rig.reference().white_level = sizes.camera.white_level;
  auto* projector = std::get_if<PinholeModel>(&rig.projector.model);
  if (projector != nullptr && sizes.display) {
    projector->width_px = sizes.display->width_px;
    projector->height_px = sizes.display->height_px;
  }
  return rig;
}

/// What the devices report, as the start values of a calibration. Of a rig that is not calibrated,
/// the rest stays.
Rig start_rig(const std::filesystem::path& file,
              const std::optional<Rig>& known,
              const Sizes& sizes) {
  if (known && known->projector.is_angular() && !sizes.display) return with_sizes(*known, sizes);
  if (!sizes.display) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: the fringes of a phase shifter need their geometry: create the "
                            "project from a rig.toml with [projector] model = \"angular\", such as "
                            "the example lab-piezo",
                            file.string()));
  }
  if (known && !known->projector.is_angular()) return with_sizes(*known, sizes);
  Rig rig;
  PinholeModel projector;
  for (CameraModel* model : {&rig.reference().model, &projector})
    model->focal_px = model->principal_point_px = Eigen::Vector2d::Constant(kMissing);
  rig.projector.model = projector;
  rig.projector.position_mm.setConstant(kMissing);
  rig.projector.rotation.setConstant(kMissing);
  return with_sizes(rig, sizes);
}

void check_sizes(const std::filesystem::path& file, const Rig& rig, const Sizes& sizes) {
  const CameraModel& camera = rig.reference().model;
  if (camera.width_px != sizes.camera.width_px || camera.height_px != sizes.camera.height_px) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: this rig is calibrated for a camera of {} x {} pixels, but the "
                            "chosen one has {} x {}; choose another one, set its region_px, or "
                            "create a project for these devices",
                            file.string(),
                            camera.width_px,
                            camera.height_px,
                            sizes.camera.width_px,
                            sizes.camera.height_px));
  }
  const auto* projector = std::get_if<PinholeModel>(&rig.projector.model);
  if (projector == nullptr || !sizes.display) return;
  const auto image = image_size(rig.projector.pixels, projector->width_px, projector->height_px);
  if (image[0] != sizes.display->width_px || image[1] != sizes.display->height_px) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: this rig is calibrated for a projector of {} x {} pixels, but the "
                            "chosen one shows {} x {}; choose another one, or create a project "
                            "for these devices",
                            file.string(),
                            image[0],
                            image[1],
                            sizes.display->width_px,
                            sizes.display->height_px));
  }
}

void require_table(const std::vector<DeviceSettings>& devices,
                   const std::string& table,
                   const char* refusal) {
  const bool has = std::any_of(devices.begin(), devices.end(), [&](const DeviceSettings& one) {
    return one.device() == table;
  });
  require(has, refusal);
}

/// The tables of further cameras, which are not chosen here.
std::vector<DeviceSettings> further_cameras(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return {};
  std::vector<DeviceSettings> devices = read_device_settings(file);
  std::erase_if(devices,
                [](const DeviceSettings& one) { return !one.device().starts_with("camera-"); });
  return devices;
}

}  // namespace

void choose_devices(const ProjectFolder& project,
                    const std::vector<DeviceChoice>& choices,
                    const std::vector<Driver>& drivers,
                    Guardian* guardian,
                    const Run& run) {
  const std::filesystem::path file = project.rig();
  std::vector<DeviceSettings> devices;
  for (const DeviceChoice& choice : choices)
    devices.push_back(parse_device_table(choice.lines, file, choice.table));
  check_given_devices(devices);
  require_table(devices, "camera", "choose a camera");
  require_table(
      devices, "fringes", "choose what shows the fringes: a projector or a phase shifter");
  const std::optional<Rig> calibrated = known_rig(project, RigContent::Complete);
  const std::optional<Rig> known =
      calibrated ? calibrated : known_rig(project, RigContent::StartValues);
  const Rig stub = known ? *known : Rig{};
  const Sizes sizes = sizes_of(devices, stub, drivers, guardian, run);
  if (calibrated) check_sizes(file, *calibrated, sizes);
  std::string text = rig_text(calibrated ? *calibrated : start_rig(file, known, sizes));
  for (DeviceSettings& camera : further_cameras(file))
    devices.push_back(std::move(camera));
  for (const DeviceSettings& device : devices)
    text += fmt::format("\n[devices.{}]\n{}", device.device(), device_table_lines(device));
  keep_rig(project, RigChange::Devices);
  write_text_file(file, text);
}

}  // namespace frangia
