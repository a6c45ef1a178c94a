#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>

#include "frangia/acquisition/measure_display.h"
#include "frangia/cad/cad_model.h"
#include "frangia/core/folder_lock.h"
#include "frangia/devices/find_devices.h"
#include "frangia/inspection/inspection_plan.h"
#include "frangia/rig/rig.h"
#include "frangia/service/acceptance_record.h"
#include "frangia/service/calibrate_axis.h"
#include "frangia/service/calibration_wizard.h"
#include "frangia/service/capture_settings.h"
#include "frangia/service/check_scan.h"
#include "frangia/service/hand_measurements.h"
#include "frangia/service/internal/exported_files.h"
#include "frangia/service/internal/surface_model.h"
#include "frangia/service/internal/surface_versions.h"
#include "frangia/service/job_queue.h"
#include "frangia/service/live_preview.h"
#include "frangia/service/part_series.h"
#include "frangia/service/project_folder.h"
#include "frangia/service/project_scan.h"
#include "frangia/service/rig_history.h"
#include "frangia/service/service.h"

namespace frangia {

/// A device of the rig and its last test, whose answer is empty before it.
struct ProjectDevice {
  DeviceTest test;
  std::string settings;  ///< lines of its table in rig.toml
};

/// What a search for devices found.
struct DeviceSearch {
  std::vector<ConnectedDevice> connected;
  std::vector<Driver> drivers;        ///< all of the program
  std::vector<std::string> warnings;  ///< of drivers whose search failed
};

/// A file that the surface is compared with.
struct ProjectReference {
  std::string name;    ///< for people, as the file was called; empty: there is none
  std::string format;  ///< of a format that set-reference takes
  int number = 0;      ///< of its file, see ProjectFolder::reference

  bool operator==(const ProjectReference&) const = default;
};

/// The reference of a project; without a name when there is none.
[[nodiscard]] ProjectReference reference_of(const ProjectFolder& project);

/// The faces of a CAD reference.
struct ReferenceFaces {
  std::vector<CadFace> faces;
  std::vector<std::uint32_t> of_triangle;  ///< index into `faces`, of each triangle of its mesh
};

/// The open project as the service knows it.
struct OpenProject {
  ProjectFolder folder;
  int opening = 0;                   ///< how many projects were opened until this one was
  std::shared_ptr<FolderLock> lock;  ///< against other programs; null where nobody may write
  bool can_scan = false;             ///< its rig names devices
  bool scan_complete = false;        ///< scan.toml exists
  bool scan_begun = false;           ///< it has frames, captured or opened: settings are fixed
  CaptureSettings capture;
  BuildSettings build;           ///< since the project was opened
  std::optional<Rig> rig;        ///< a calibrated one
  std::optional<Rig> start;      ///< of one that is not calibrated: what is known before
  std::string rig_fault;         ///< why there is no calibrated rig
  std::int64_t residuals_s = 0;  ///< when the residuals of its calibration were written; 0: never
  std::vector<ProjectDevice> devices;
  std::shared_ptr<LivePreview> live;          ///< while a preview runs
  std::shared_ptr<CalibrationWizard> wizard;  ///< since a calibration began
  std::optional<FoundAxis> axis;              ///< of the turntable, since it was searched for
  std::string axis_fault;          ///< why the scan does not show it; empty: it was not asked
  std::optional<ScanCheck> check;  ///< what the devices see before a scan
  std::optional<DisplayMeasurement> display;  ///< since it was measured
  std::vector<KeptRig> kept_rigs;             ///< that the project had, the newest first
  std::vector<ProjectStation> stations;
  std::shared_ptr<DecodedViews> decoded;  ///< of the scan that was captured here; null before
  std::optional<GrownSurface> grown;      ///< while its scan runs and until it is built
  /// Why the scan did not go on: the angle of its turntable is unknown.
  std::optional<UnknownTableAngle> unknown_angle;
  /// Null when versions.json cannot be read, until it can.
  std::shared_ptr<const SurfaceVersions> versions;
  SurfacePtr surface;            ///< the current version; null without one, or until it is read
  bool surface_loading = false;  ///< there is one, and `open_job` reads it
  int open_job = 0;              ///< number of the job; 0: it begins in a moment
  std::vector<ExportEntry> exports;
  ProjectReference reference;
  PicturePtr reference_picture;                           ///< since it was asked for; null before
  std::shared_ptr<const ReferenceFaces> reference_faces;  ///< with the picture; null of a mesh
  std::vector<HandMeasurement> measurements;
  std::vector<SeriesPart> series;              ///< parts before this one, the oldest first
  std::optional<AcceptanceRecord> acceptance;  ///< of the series; none: nothing is tested
  std::optional<InspectionPlan> plan;          ///< without its reference; none: none was made
  std::string plan_fault;                      ///< why the plan in the folder cannot be read
};

/// Reads the plan of a project into it.
void read_plan_of(const ProjectFolder& folder, OpenProject& project);

/// Whether its surface was inspected by the present plan against the present reference.
[[nodiscard]] bool has_current_inspection(const OpenProject& project);

/// Whether its camera is one in software.
[[nodiscard]] bool is_simulated(const OpenProject& project);

/// Whether the parts of its rig can be moved by hand: they are simulated, and nothing was measured
/// of them.
[[nodiscard]] bool is_adjustable(const OpenProject& project);

/// How far a project has come, for those who word its command lines.
[[nodiscard]] ProjectProgress progress_of(const OpenProject& project);

/// All that the state of a service shows.
struct ServiceView {
  std::string version;
  std::vector<ProjectEntry> projects;
  std::vector<LibraryRig> rigs;
  DiscardedProjects bin;                       ///< what was deleted
  std::shared_ptr<const DeviceSearch> search;  ///< null before the first one
  std::optional<OpenProject> project;
  CommandLines commands;  ///< of the project
  std::vector<Job> jobs;
};

/// The state as docs/service-api.md describes it.
[[nodiscard]] std::string state_json(const ServiceView& view);

/// A station as stations.json and the state of the service hold it.
[[nodiscard]] nlohmann::ordered_json json_of(const ProjectStation& station);

/// The station that `json_of` wrote; one that was being captured waits again.
///
/// @errors   nlohmann::json::exception for missing keys and other types
[[nodiscard]] ProjectStation station_from(const nlohmann::json& json);

}  // namespace frangia
