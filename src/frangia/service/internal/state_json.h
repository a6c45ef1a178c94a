#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "frangia/core/folder_lock.h"
#include "frangia/rig/rig.h"
#include "frangia/service/calibration_wizard.h"
#include "frangia/service/capture_settings.h"
#include "frangia/service/internal/surface_model.h"
#include "frangia/service/job_queue.h"
#include "frangia/service/live_preview.h"
#include "frangia/service/project_folder.h"
#include "frangia/service/project_scan.h"
#include "frangia/service/service.h"

namespace frangia {

/// A file in a project's exports.
struct ExportEntry {
  std::string name;
  std::size_t bytes = 0;
};

/// A device of the rig and its last test.
struct ProjectDevice {
  std::string table;   ///< "camera", "fringes", ...
  std::string driver;  ///< as rig.toml names it
  std::string name;    ///< as the device names itself; empty before a test
  std::string answer;  ///< to its test
  std::string fault;   ///< instead of an answer
};

/// A file that the surface is compared with.
struct ProjectReference {
  std::string name;    ///< for people, as the file was called; empty: there is none
  std::string format;  ///< one of reference_formats
};

/// The reference of a project; without a name when there is none.
[[nodiscard]] ProjectReference reference_of(const ProjectFolder& project);

/// The open project as the service knows it.
struct OpenProject {
  ProjectFolder folder;
  std::shared_ptr<FolderLock> lock;  ///< against other programs; null where nobody may write
  bool can_scan = false;             ///< its rig names devices
  bool scan_complete = false;        ///< scan.toml exists
  bool scan_begun = false;           ///< frames were captured: settings are fixed
  CaptureSettings capture;
  std::optional<Rig> rig;
  std::string rig_fault;  ///< why there is no rig
  std::vector<ProjectDevice> devices;
  std::shared_ptr<LivePreview> live;          ///< while a preview runs
  std::shared_ptr<CalibrationWizard> wizard;  ///< since a calibration began
  std::vector<ProjectStation> stations;
  /// Why the scan did not go on: the angle of its turntable is unknown.
  std::optional<UnknownTableAngle> unknown_angle;
  std::string summary;  ///< JSON of the reconstruction; empty without one
  SurfacePtr surface;   ///< null without one, or until it is read
  std::vector<ExportEntry> exports;
  ProjectReference reference;
};

/// All that the state of a service shows.
struct ServiceView {
  std::string version;
  std::vector<ProjectEntry> projects;
  std::optional<OpenProject> project;
  CommandLines commands;  ///< of the project
  std::vector<Job> jobs;
};

/// The state as docs/service-api.md describes it.
[[nodiscard]] std::string state_json(const ServiceView& view);

}  // namespace frangia
