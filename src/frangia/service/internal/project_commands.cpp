#include <filesystem>

#include "frangia/core/error.h"
#include "frangia/core/read_text_file.h"
#include "frangia/devices/device_settings.h"
#include "frangia/rig/read_rig.h"
#include "frangia/service/internal/implementation.h"
#include "frangia/service/simulated_rig.h"

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

/// The rig and the settings of its capture. A damaged file is reported by the step that needs it.
void read_rig_of(const ProjectFolder& folder, OpenProject& project) {
  std::error_code ignored;
  try {
    project.rig = std::filesystem::exists(folder.rig(), ignored) ? read_rig(folder.rig())
                                                                 : std::optional<Rig>();
    for (DeviceSettings& device : read_device_settings(folder.rig()))
      project.devices.push_back({.table = device.device(), .driver = device.text_or("driver", "")});
    project.capture = read_capture_settings(folder.capture());
  } catch (const Error& error) {
    project.rig_fault = error.what();
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

}  // namespace

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
  project.can_scan = names_devices(folder) && folder.scan != folder.folder;
  std::error_code ignored;
  project.scan_complete = std::filesystem::exists(folder.scan / "scan.toml", ignored);
  project.stations = read_stations(folder);
  project.exports = exports_of(folder);
  project.reference = reference_of(folder);
  project.scan_begun = std::filesystem::exists(folder.scan / "capture", ignored);
  read_rig_of(folder, project);
  try {
    project.summary = read_text_file(folder.summary());
  } catch (const Error&) {
    project.summary.clear();  // none was made, or it was deleted
  }
  {
    const std::lock_guard lock(mutex_);
    project_ = std::move(project);
  }
  on_change_();
  static_cast<void>(queue_.start("open", [this, folder](const Run& run) {
    drop_model();
    std::error_code error;
    if (std::filesystem::exists(folder.surface(), error)) load_surface(folder, run);
  }));
}
nlohmann::ordered_json Service::Implementation::create_project(CommandArguments& arguments) {
  const std::string name = arguments.text("name");
  const std::string part = arguments.text_or("part", "bust");
  constexpr std::size_t kUsual = 8;
  const std::size_t stations = arguments.whole_or("stations", kUsual, 1, kMostStations);
  arguments.check_all_read();
  require_idle();
  const ProjectFolder project = library_.create(name);
  try {
    write_simulated_rig(project.rig(), part);
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
  open(library_.find(name));
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
void Service::Implementation::require_idle() const {
  for (const Job& job : queue_.jobs()) {
    const bool unfinished = job.state == JobState::Waiting || job.state == JobState::Running;
    require(!unfinished || job.kind == "live",
            "a task is running; stop it, or let it finish, first");
  }
}

}  // namespace frangia
