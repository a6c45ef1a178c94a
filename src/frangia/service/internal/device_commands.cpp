#include <map>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/devices/find_devices.h"
#include "frangia/rig/read_rig.h"
#include "frangia/service/choose_devices.h"
#include "frangia/service/display_level.h"
#include "frangia/service/internal/implementation.h"

namespace frangia {
namespace {

constexpr std::array kTables = {"camera", "fringes", "line", "light", "turntable"};

/// Devices that a job uses: the program learns of them, and a guardian watches them.
struct WatchedDevices {
  std::shared_ptr<void> hold;
  std::optional<Guardian> guardian;

  explicit WatchedDevices(const CaptureSetup& setup)
      : hold(setup.hold_devices ? setup.hold_devices() : nullptr) {
    if (setup.guardian) guardian.emplace(*setup.guardian);
  }
  [[nodiscard]] Guardian* watcher() { return guardian ? &*guardian : nullptr; }
};

}  // namespace

nlohmann::ordered_json Service::Implementation::start_find_devices(CommandArguments& arguments) {
  arguments.check_all_read();
  require_idle();
  return started("find", [this](const Run& run) {
    run.stage("devices");
    auto search = std::make_shared<DeviceSearch>();
    Run listening = run;
    listening.on_warning = [&](const std::string& sentence) {
      search->warnings.push_back(sentence);
      run.warn(sentence);
    };
    search->drivers = options_.capture.drivers();
    search->connected = find_devices(search->drivers, listening);
    run.note(fmt::format("{} devices found", search->connected.size()));
    {
      const std::lock_guard lock(mutex_);
      search_ = search;
    }
    on_change_();
  });
}

/// Shows on each monitor its number.
nlohmann::ordered_json Service::Implementation::start_identify(CommandArguments& arguments) {
  arguments.check_all_read();
  require_idle();
  stop_live();
  return started("identify", [this](const Run& run) {
    run.stage("devices");
    constexpr double kTimeout_s = 20.0;
    for (const Driver& driver : options_.capture.drivers())
      if (driver.identify) driver.identify(Deadline::in(kTimeout_s, run.stop));
  });
}

/// Replaces the devices of the project's rig, and tests them.
nlohmann::ordered_json Service::Implementation::start_set_devices(CommandArguments& arguments) {
  const std::map<std::string, std::string> given = arguments.texts("devices", kTables.size());
  arguments.check_all_read();
  const OpenProject project = opened();
  require(project.folder.scan != project.folder.folder,
          "this folder holds a finished scan; create a project to scan with devices");
  require(!project.scan_begun,
          "the scan has begun with these devices; create a project for other ones");
  std::vector<DeviceChoice> choices;
  for (const auto& [table, lines] : given) {
    require(std::find(kTables.begin(), kTables.end(), table) != kTables.end(),
            "devices: the tables are camera, fringes, line, light and turntable");
    choices.push_back({table, lines});
  }
  require_idle();
  return started("devices", [this, choices, folder = project.folder](const Run& run) {
    run.stage("devices");
    {
      WatchedDevices watched(options_.capture);
      choose_devices(folder, choices, options_.capture.drivers(), watched.watcher(), run);
    }
    forget_verdicts();
    reload_rig(folder);
    run_device_test(folder, run);
  });
}

nlohmann::ordered_json Service::Implementation::start_test_devices(CommandArguments& arguments) {
  arguments.check_all_read();
  const OpenProject project = opened();
  require(project.can_scan, "this project has no rig with devices");
  return started("devices",
                 [this, folder = project.folder](const Run& run) { run_device_test(folder, run); });
}

/// Fits display and camera to each other; also before the rig is calibrated.
nlohmann::ordered_json Service::Implementation::start_measure_display(CommandArguments& arguments) {
  arguments.check_all_read();
  const OpenProject project = opened();
  require(project.can_scan, "this project has no rig with devices");
  require(!project.scan_begun,
          "the scan has begun with this rig; create a project for another one");
  require_idle();
  return started("display", [this, project](const Run& run) {
    run.stage("devices");
    const DisplayMeasurement found =
        measure_project_display(project.folder, project.capture, options_.capture, run);
    change([&](OpenProject& now) {
      now.display = found;
      now.check.reset();
    });
    reload_rig(project.folder);
  });
}

/// Tests the devices and, with a calibrated rig, looks at one view: all that a scan needs.
nlohmann::ordered_json Service::Implementation::start_check_scan(CommandArguments& arguments) {
  arguments.check_all_read();
  const OpenProject project = opened();
  require(project.can_scan, "this project has no rig with devices");
  require_idle();
  stop_live();
  return started("devices", [this, project](const Run& run) {
    change([](OpenProject& now) { now.check.reset(); });
    run_device_test(project.folder, run);
    if (!project.rig) return;
    const ScanCheck found = check_scan(project.folder, project.capture, options_.capture, run);
    change([&](OpenProject& now) {
      if (now.capture == project.capture) now.check = found;  // otherwise it is of other settings
    });
  });
}

void Service::Implementation::run_device_test(const ProjectFolder& folder, const Run& run) {
  std::vector<DeviceTest> tests;
  {
    WatchedDevices watched(options_.capture);
    const Rig rig = read_rig(folder.rig(), run, RigContent::StartValues);
    tests = test_devices(folder.rig(), rig, options_.capture.drivers(), watched.watcher(), run);
  }
  change([&](OpenProject& now) {
    for (const DeviceTest& test : tests) {
      for (ProjectDevice& device : now.devices)
        if (device.test.table == test.table) device.test = test;
    }
  });
  for (const DeviceTest& test : tests) {
    if (!test.fault.empty())
      throw Error(ErrorKind::Device, fmt::format("{}: {}", test.table, test.fault));
  }
}

}  // namespace frangia
