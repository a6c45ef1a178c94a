#include <filesystem>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/rig/read_rig.h"
#include "frangia/rig/write_rig.h"
#include "frangia/service/arrange_rig.h"
#include "frangia/service/internal/implementation.h"
#include "frangia/service/internal/opened_devices.h"
#include "frangia/service/simulated_rig.h"

namespace frangia {
namespace {

/// Opens and queries every device of a rig, even if another one fails.
std::vector<ProjectDevice> tested(const ProjectFolder& project,
                                  const CaptureSetup& setup,
                                  const Run& run) {
  constexpr double kTimeout_s = 10.0;
  const std::shared_ptr<void> hold = setup.hold_devices ? setup.hold_devices() : nullptr;
  std::optional<Guardian> guardian;
  if (setup.guardian) guardian.emplace(*setup.guardian);
  const Rig rig = read_rig(project.rig(), run, RigContent::StartValues);
  const auto drivers = setup.drivers();
  std::vector<Guardian::Watch> watches;
  std::vector<std::unique_ptr<Device>> opened;  // kept open: tables may share a board
  std::vector<ProjectDevice> all;
  for (DeviceSettings& settings : read_device_settings(project.rig())) {
    ProjectDevice entry{.table = settings.device(), .driver = settings.text_or("driver", "")};
    try {
      opened.push_back(
          driver_for(settings, drivers).open(settings, rig, Deadline::in(kTimeout_s, run.stop)));
      if (const auto how = opened.back()->safe_off(); how && guardian)
        watches.push_back(guardian->watch(*how));
      entry.name = opened.back()->name();
      entry.answer = opened.back()->test(Deadline::in(kTimeout_s, run.stop));
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::Cancelled) throw;
      entry.fault = error.what();
    }
    all.push_back(std::move(entry));
  }
  std::vector<Device*> devices;
  for (const auto& device : opened)
    devices.push_back(device.get());
  make_safe(devices);
  return all;
}

/// Replaces a rig.toml; its [devices] tables stay.
void replace_rig(const std::filesystem::path& file, const Rig& rig) {
  const std::filesystem::path fresh = file.parent_path() / "rig-arranged.toml";
  write_rig(fresh, rig, Durability::Synced, file);
  std::filesystem::rename(fresh, file);
}

}  // namespace

nlohmann::ordered_json Service::Implementation::test_devices(CommandArguments& arguments) {
  arguments.check_all_read();
  const OpenProject project = opened();
  require(project.can_scan, "this project has no rig with devices");
  return started("devices", [this, folder = project.folder](const Run& run) {
    const auto found = tested(folder, options_.capture, run);
    change([&](OpenProject& now) { now.devices = found; });
    for (const ProjectDevice& device : found) {
      if (!device.fault.empty())
        throw Error(ErrorKind::Device, fmt::format("{}: {}", device.table, device.fault));
    }
  });
}

nlohmann::ordered_json Service::Implementation::set_rig(CommandArguments& arguments) {
  const OpenProject project = opened();
  RigArrangement wanted;
  wanted.baseline_mm = arguments.positive("baseline_mm");
  wanted.distance_mm = arguments.positive("distance_mm");
  wanted.camera_focal_px = arguments.positive("camera_focal_px");
  wanted.projector_focal_px = arguments.positive("projector_focal_px");
  arguments.check_all_read();
  require(project.rig.has_value(), "this project has no rig");
  require(!project.scan_begun,
          "the scan has begun with this rig; create a project for another one");
  require_idle();
  stop_live();
  const std::filesystem::path truth = true_rig_beside(project.folder.rig());
  std::error_code ignored;
  if (std::filesystem::exists(truth, ignored))  // the simulated parts move as well
    replace_rig(truth, arrange_rig(read_rig(truth), wanted));
  const Rig rig = arrange_rig(*project.rig, wanted);
  replace_rig(project.folder.rig(), rig);
  change([&](OpenProject& now) { now.rig = rig; });
  return Json::object();
}

#ifdef FRANGIA_WITH_CALIBRATION
nlohmann::ordered_json Service::Implementation::start_calibration(CommandArguments& arguments) {
  const OpenProject project = opened();
  constexpr std::size_t kFewestPoints = 3;
  constexpr std::size_t kMostPoints = 100;
  constexpr std::size_t kUsualColumns = 10;
  constexpr std::size_t kUsualRows = 7;
  constexpr std::size_t kUsualPoses = 12;
  Board board;
  const auto square_mm = arguments.positive("square_mm");
  require(square_mm.has_value(), "square_mm: the side of a square is missing here");
  board.square_mm = *square_mm;
  board.columns =
      static_cast<int>(arguments.whole_or("columns", kUsualColumns, kFewestPoints, kMostPoints));
  board.rows = static_cast<int>(arguments.whole_or("rows", kUsualRows, kFewestPoints, kMostPoints));
  const std::size_t poses = arguments.whole_or("poses", kUsualPoses, 3, kMostPoints);
  arguments.check_all_read();
  require(project.can_scan, "this project has no rig with devices");
  require(!project.scan_begun, "the scan has begun with this rig; create a project to calibrate");
  check_board(board);
  require_idle();
  const auto wizard = std::make_shared<CalibrationWizard>(project.folder, [this] {
    on_change_();
    if (options_.on_picture) options_.on_picture();
  });
  change([&](OpenProject& now) { now.wizard = wizard; });
  return started("calibrate",
                 [this, wizard, board, poses, folder = project.folder](const Run& run) {
                   wizard->run(board, poses, options_.capture, run);
                   const Rig rig = read_rig(folder.rig(), run);
                   change([&](OpenProject& now) { now.rig = rig; });
                 });
}

nlohmann::ordered_json Service::Implementation::capture_pose(CommandArguments& arguments) {
  arguments.check_all_read();
  const auto wizard = opened().wizard;
  require(wizard != nullptr, "no calibration runs; start it first");
  wizard->capture_pose();
  return Json::object();
}

nlohmann::ordered_json Service::Implementation::end_poses(CommandArguments& arguments) {
  arguments.check_all_read();
  const auto wizard = opened().wizard;
  require(wizard != nullptr, "no calibration runs; start it first");
  wizard->end_poses();
  return Json::object();
}
#else
namespace {
[[noreturn]] void fail_without_calibration() {
  throw Error(ErrorKind::Input, "this program was built without calibration");
}
}  // namespace

nlohmann::ordered_json Service::Implementation::start_calibration(CommandArguments& /*none*/) {
  fail_without_calibration();
}
nlohmann::ordered_json Service::Implementation::capture_pose(CommandArguments& /*none*/) {
  fail_without_calibration();
}
nlohmann::ordered_json Service::Implementation::end_poses(CommandArguments& /*none*/) {
  fail_without_calibration();
}
#endif

}  // namespace frangia
