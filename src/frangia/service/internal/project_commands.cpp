#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/devices/device_settings.h"
#include "frangia/devices/device_table.h"
#include "frangia/rig/read_rig.h"
#include "frangia/service/example_rigs.h"
#include "frangia/service/internal/implementation.h"
#include "frangia/service/rig_history.h"

namespace frangia {
namespace {

bool names_devices(const ProjectFolder& project) {
  std::error_code ignored;
  if (!std::filesystem::exists(project.rig(), ignored)) return false;
  try {
    return !read_device_settings(project.rig()).empty();
  } catch (const Error&) {
    return false;  // the scan says what is wrong with the file
  }
}

std::optional<Rig> start_values(const std::filesystem::path& file) {
  try {
    return read_rig(file, {}, RigContent::StartValues);
  } catch (const Error&) {
    return std::nullopt;  // the complete reading has said what is wrong
  }
}

/// Keeps other servers from editing the same project; null where nobody may write.
///
/// @errors   Error(Input) that names the process which has the project open
std::shared_ptr<FolderLock> lock_of(const ProjectFolder& project) {
  try {
    return std::make_shared<FolderLock>(project.derived);
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::File) return nullptr;  // it can be looked at
    throw;
  }
}

/// Writes the rig.toml of a new project.
struct NewRig {
  std::string part;      ///< of the simulated rig, unless one of the others is given
  std::string example;   ///< name
  GivenRig given;        ///< its text may be empty
  bool devices = false;  ///< none yet: the devices are chosen in the step Rig
  std::string kept;      ///< name of a rig that was kept

  void write(const ProjectFolder& project, const RigLibrary& rigs) const {
    if (devices) return;
    if (!kept.empty()) return rigs.give(kept, project);
    if (!given.rig.empty()) return write_given_rig(project, given);
    if (!example.empty()) return write_example_rig(project.rig(), example);
    write_simulated_rig(project.rig(), part);
  }
};

}  // namespace

bool was_captured(const ProjectFolder& project) {
  std::error_code ignored;
  return std::filesystem::exists(project.in_scan("capture"), ignored);
}

void read_rig_of(const ProjectFolder& folder, OpenProject& project) {
  project.rig.reset();
  project.start.reset();
  project.rig_fault.clear();
  project.devices.clear();
  project.can_scan = names_devices(folder) && folder.scan != folder.folder;
  project.residuals_s = modified_s(folder.residuals());
  project.kept_rigs = kept_rigs(folder);
  std::error_code ignored;
  if (!std::filesystem::exists(folder.rig(), ignored)) return;
  try {
    static_cast<void>(folder.in_folder("true-rig.toml"));  // simulated devices read it
    for (DeviceSettings& device : read_device_settings(folder.rig())) {
      const DeviceTest untested{.table = device.device(), .driver = device.text_or("driver", "")};
      project.devices.push_back({untested, device_table_lines(device)});
    }
    project.capture = read_capture_settings(folder.capture());
    project.rig = read_rig(folder.rig());
  } catch (const Error& error) {
    project.rig_fault = error.what();
    project.start = start_values(folder.rig());
  }
}

bool is_simulated(const OpenProject& project) {
  return std::any_of(
      project.devices.begin(), project.devices.end(), [](const ProjectDevice& device) {
        return device.test.table == "camera" && device.test.driver == "simulated";
      });
}

bool is_adjustable(const OpenProject& project) {
  return is_simulated(project) && project.rig && !project.rig->calibration;
}

void Service::Implementation::reload_rig(const ProjectFolder& folder) {
  OpenProject fresh;
  read_rig_of(folder, fresh);
  change([&](OpenProject& now) {
    now.rig = fresh.rig;
    now.start = fresh.start;
    now.rig_fault = fresh.rig_fault;
    for (ProjectDevice& device : fresh.devices) {
      for (const ProjectDevice& known : now.devices) {
        if (known.test.table == device.test.table && known.settings == device.settings)
          device.test = known.test;
      }
    }
    now.devices = fresh.devices;
    now.exports = exports_of(folder);
    now.can_scan = fresh.can_scan;
    now.residuals_s = fresh.residuals_s;
    now.kept_rigs = fresh.kept_rigs;
  });
}

void Service::Implementation::require_folder() const {
  const std::lock_guard lock(mutex_);
  std::error_code ignored;
  if (!project_ || std::filesystem::is_directory(project_->folder.folder, ignored)) return;
  throw Error(ErrorKind::Input,
              fmt::format("{}: the folder of this project is gone; put it back, or close the "
                          "project and open another one",
                          project_->folder.folder.string()));
}

void Service::Implementation::open(const ProjectFolder& folder) {
  require_idle();
  stop_live();
  OpenProject project;
  project.folder = folder;
  {
    const std::lock_guard lock(mutex_);
    if (project_ && project_->folder.derived == folder.derived) project.lock = project_->lock;
  }
  if (!project.lock) project.lock = lock_of(folder);
  std::error_code ignored;
  project.scan_complete = std::filesystem::exists(folder.in_scan("scan.toml"), ignored);
  project.scan_begun = project.scan_complete || was_captured(folder);
  project.stations = read_stations(folder);
  project.exports = exports_of(folder);
  project.reference = reference_of(folder);
  project.measurements = read_hand_measurements(folder);
  project.series = read_series(library_, folder);
  project.acceptance = read_acceptance(library_, folder);
  read_plan_of(folder, project);
  bool loads = true;
  try {
    const auto versions = std::make_shared<const SurfaceVersions>(read_surface_versions(folder));
    loads = versions->current != 0;
    project.versions = versions;
  } catch (const Error&) {  // NOLINT(bugprone-empty-catch): the job below says what is wrong
  }
  project.surface_loading = loads;
  const bool writable = project.lock != nullptr;
  read_rig_of(folder, project);
  {
    const std::lock_guard lock(mutex_);
    project.opening = ++openings_;
    project_ = std::move(project);
  }
  on_change_();
  const int job = queue_.start("open", [this, folder, loads, writable](const Run& run) {
    use_opened();
    if (!loads) return;
    static_cast<void>(model_of(folder, "there is no surface", run));
    refine(run);
    if (writable) remove_leftovers(folder, *versions_of(folder));
  });
  change([job](OpenProject& opened) { opened.open_job = job; });
}

void Service::Implementation::open_folder(const std::filesystem::path& folder) {
  const std::lock_guard one_at_a_time(command_mutex_);
  open(project_in(folder));
}

nlohmann::ordered_json Service::Implementation::create_project(CommandArguments& arguments) {
  const std::string name = arguments.text("name");
  const NewRig rig{.part = arguments.text_or("part", "bust"),
                   .example = arguments.text_or("example", ""),
                   .given = {.rig = arguments.text_or("rig", ""),
                             .covariance = arguments.text_or("covariance", "")},
                   .devices = arguments.flag("devices"),
                   .kept = arguments.text_or("kept_rig", "")};
  constexpr std::size_t kUsual = 8;
  const std::size_t stations = arguments.whole_or("stations", kUsual, 1, kMostStations);
  arguments.check_all_read();
  const int sources = (rig.example.empty() ? 0 : 1) + (rig.given.rig.empty() ? 0 : 1) +
                      (rig.devices ? 1 : 0) + (rig.kept.empty() ? 0 : 1);
  require(sources <= 1, "example, rig, kept_rig and devices exclude each other; give one of them");
  require_idle();
  const ProjectFolder project = library_.create(name);
  try {
    rig.write(project, rigs_);
    write_stations(project, planned_stations(stations));
  } catch (const Error&) {
    std::error_code ignored;
    std::filesystem::remove_all(project.folder, ignored);  // created above, holds nothing else
    throw;
  }
  refresh_projects();
  open(project);
  return Json::object();
}
nlohmann::ordered_json Service::Implementation::open_project(CommandArguments& arguments) {
  const std::string name = arguments.text("name");
  arguments.check_all_read();
  try {
    open(library_.find(name));
  } catch (const Error&) {
    refresh_projects();  // it may have been deleted
    throw;
  }
  return Json::object();
}
nlohmann::ordered_json Service::Implementation::close_project(CommandArguments& arguments) {
  arguments.check_all_read();
  require_idle();
  stop_live();
  {
    const std::lock_guard lock(mutex_);
    project_.reset();
  }
  refresh_projects();
  return Json::object();
}
void Service::Implementation::require_idle(int except) const {
  for (const Job& job : queue_.jobs()) {
    const bool unfinished = job.state == JobState::Waiting || job.state == JobState::Running;
    require(!unfinished || job.kind == "live" || job.number == except,
            "a task is running; stop it, or let it finish, first");
  }
}

}  // namespace frangia
