#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "frangia/service/calibration_wizard.h"
#include "frangia/service/internal/command_arguments.h"
#include "frangia/service/internal/state_json.h"
#include "frangia/service/internal/surface_model.h"
#include "frangia/service/job_queue.h"
#include "frangia/service/live_preview.h"
#include "frangia/service/project_folder.h"
#include "frangia/service/service.h"

namespace frangia {

/// The state behind a mutex, and the queue whose one thread changes the surface.
class Service::Implementation {
 public:
  Implementation(ServiceOptions options, std::function<void()> on_change);

  void open(const ProjectFolder& folder);
  std::string command(const std::string& name, const std::string& text);
  [[nodiscard]] std::string state() const;
  [[nodiscard]] SurfacePtr surface() const;
  /// @errors   Error(Input) when no project is open
  [[nodiscard]] ProjectFolder folder() const;
  [[nodiscard]] std::string cloud(std::size_t station) const;
  [[nodiscard]] std::string setup_cloud(std::size_t joined) const;
  void add_to_reference(std::size_t offset, const std::string& bytes) const;
  /// The residuals of the project's calibration, as docs/service-api.md describes them.
  /// @errors   Error(Input) without a calibration
  [[nodiscard]] std::string residuals() const;
  [[nodiscard]] ExportedFile exported(const std::string& name) const;
  [[nodiscard]] LivePicture live_picture(LiveLayer layer, std::uint64_t after) const;

 private:
  using Json = nlohmann::ordered_json;

  Json create_project(CommandArguments& arguments);
  Json open_project(CommandArguments& arguments);
  Json close_project(CommandArguments& arguments);

  Json set_capture(CommandArguments& arguments);
  Json start_live(CommandArguments& arguments);
  Json set_live(CommandArguments& arguments);
  Json start_scan(CommandArguments& arguments);
  Json rescan_station(CommandArguments& arguments);
  Json start_reconstruct(CommandArguments& arguments);

  Json start_find_devices(CommandArguments& arguments);
  Json start_set_devices(CommandArguments& arguments);
  Json start_test_devices(CommandArguments& arguments);
  Json start_find_exposure(CommandArguments& arguments);
  Json set_rig(CommandArguments& arguments);
  Json start_calibration(CommandArguments& arguments);
  Json capture_pose(CommandArguments& arguments);
  Json end_poses(CommandArguments& arguments);

  Json start_edit(CommandArguments& arguments);
  Json start_preview(CommandArguments& arguments);
  Json drop_preview(CommandArguments& arguments);
  Json set_reference(CommandArguments& arguments);
  Json start_compare(CommandArguments& arguments);
  Json estimate_export(CommandArguments& arguments);
  Json start_select_component(CommandArguments& arguments);
  Json start_undo(CommandArguments& arguments);
  Json start_redo(CommandArguments& arguments);
  Json start_fit(CommandArguments& arguments);
  Json start_export(CommandArguments& arguments);
  Json start_zip(const ProjectFolder& project);
  Json stop_job(CommandArguments& arguments);

  /// Starts a job. A live preview that runs is stopped first: it holds the devices and the thread.
  Json started(const char* kind, std::function<void(const Run&)> work);
  Json started_edit(const char* kind, std::function<SurfacePtr(SurfaceModel&, const Run&)> work);
  Json started_edit(std::function<SurfacePtr(SurfaceModel&, const Run&)> work);
  Json started_live(const LiveSettings& settings);
  void stop_live();
  /// Reads the rig, its devices and the settings of the capture again.
  void reload_rig(const ProjectFolder& folder);
  /// On the queue's thread: tests the devices of the project's rig.
  void run_device_test(const ProjectFolder& folder, const Run& run);
  /// @errors   Error(Input) when the folder of the open project was deleted
  void require_folder() const;
  void require_idle() const;
  /// On the queue's thread.
  void load_surface(const ProjectFolder& project, const Run& run);
  /// On the queue's thread. Shows a surface, and then its finer level.
  void show_surface(const SurfacePtr& surface, const Run& run);
  /// On the queue's thread. The next model counts on, so that no two meshes share a revision.
  void drop_model();
  void change(const std::function<void(OpenProject&)>& edit);
  void refresh_projects();
  [[nodiscard]] OpenProject opened() const;

  static constexpr std::size_t kMostStations = 360;
  static constexpr std::size_t kMostSetups = 99;

  ServiceOptions options_;
  ProjectLibrary library_;
  std::function<void()> on_change_;
  mutable std::mutex mutex_;
  std::vector<ProjectEntry> projects_;
  std::shared_ptr<const DeviceSearch> search_;
  std::optional<OpenProject> project_;
  std::unique_ptr<SurfaceModel> model_;  ///< of the queue's thread
  int revision_ = 0;                     ///< of the queue's thread
  JobQueue queue_;                       ///< last: its thread uses everything else
};

/// Reads the rig of a project, its devices and the settings of the capture into `project`. A
/// damaged file is reported by the step that needs it.
void read_rig_of(const ProjectFolder& folder, OpenProject& project);

/// Files in a project's exports, by name.
[[nodiscard]] std::vector<ExportEntry> exports_of(const ProjectFolder& project);

}  // namespace frangia
