#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "frangia/reconstruct/reconstruct.h"
#include "frangia/service/calibration_wizard.h"
#include "frangia/service/internal/command_arguments.h"
#include "frangia/service/internal/exported_files.h"
#include "frangia/service/internal/state_json.h"
#include "frangia/service/internal/surface_model.h"
#include "frangia/service/internal/surface_versions.h"
#include "frangia/service/job_queue.h"
#include "frangia/service/live_preview.h"
#include "frangia/service/project_folder.h"
#include "frangia/service/rig_history.h"
#include "frangia/service/service.h"

namespace frangia {

/// The state behind a mutex, and the queue whose one thread changes the surface.
class Service::Implementation {
 public:
  Implementation(ServiceOptions options, std::function<void()> on_change);

  void open_folder(const std::filesystem::path& folder);
  std::string command(const std::string& name, const std::string& text);
  [[nodiscard]] std::string state() const;
  [[nodiscard]] SurfacePtr surface() const;
  /// @errors   Error(Input) when no project is open
  [[nodiscard]] ProjectFolder folder() const;
  [[nodiscard]] std::string cloud(std::size_t station) const;
  [[nodiscard]] std::string grown_surface() const;
  [[nodiscard]] std::string setup_cloud(std::size_t joined) const;
  void add_to_reference(std::size_t offset, const std::string& bytes) const;
  /// The residuals of the project's calibration, as docs/service-api.md describes them.
  /// @errors   Error(Input) without a calibration
  [[nodiscard]] std::string residuals() const;
  [[nodiscard]] std::string thumbnail(const std::string& name) const;
  [[nodiscard]] ExportedFile exported(const std::string& name) const;
  /// The reference as it is drawn; null before `show-reference`.
  [[nodiscard]] PicturePtr reference_picture() const;
  /// The face of a CAD reference that a triangle of its picture belongs to; null of a mesh.
  [[nodiscard]] nlohmann::ordered_json reference_face(std::uint32_t triangle) const;
  /// The curves in which a plane cuts the surface, as docs/service-api.md describes them.
  [[nodiscard]] std::string section(const std::string& plane_json) const;
  [[nodiscard]] LivePicture live_picture(LiveLayer layer, std::uint64_t after) const;

 private:
  using Json = nlohmann::ordered_json;

  /// What a job makes of the present model. The number is the revision that it becomes or, of what
  /// is shown beside the surface and not kept, a count.
  using SurfaceWork = std::function<SurfaceModel(const SurfaceModel&, int, const Run&)>;

  void open(const ProjectFolder& folder);
  /// The answer to a command that was carried out before; null otherwise.
  Json answer_given(const CommandKey& key) const;
  Json create_project(CommandArguments& arguments);
  Json open_project(CommandArguments& arguments);
  Json close_project(CommandArguments& arguments);

  Json rename_project(CommandArguments& arguments);
  Json duplicate_project(CommandArguments& arguments);
  Json discard_project(CommandArguments& arguments);
  Json take_back_project(CommandArguments& arguments);
  Json empty_bin(CommandArguments& arguments);
  Json set_notes(CommandArguments& arguments);
  Json set_thumbnail(CommandArguments& arguments);
  Json open_file(CommandArguments& arguments);
  /// Leaves the open project when it has this name, and says whether it had.
  bool leave(const std::string& name);

  Json set_capture(CommandArguments& arguments);
  Json start_live(CommandArguments& arguments);
  Json set_live(CommandArguments& arguments);
  Json start_scan(CommandArguments& arguments);
  Json rescan_station(CommandArguments& arguments);
  /// On the queue's thread: finds the axis by the complete scan.
  void find_axis_of_scan(const ProjectFolder& project, const Run& run);
  Json start_reconstruct(CommandArguments& arguments);
  Json start_open_version(CommandArguments& arguments);
  Json start_replay(CommandArguments& arguments);

  Json start_find_devices(CommandArguments& arguments);
  Json start_identify(CommandArguments& arguments);
  Json start_set_devices(CommandArguments& arguments);
  Json start_test_devices(CommandArguments& arguments);
  Json start_check_scan(CommandArguments& arguments);
  Json start_measure_display(CommandArguments& arguments);
  Json start_find_exposure(CommandArguments& arguments);
  Json set_rig(CommandArguments& arguments);
  Json restore_rig_before(CommandArguments& arguments);
  Json keep_rig_as(CommandArguments& arguments);
  Json discard_rig(CommandArguments& arguments);
  Json start_calibration(CommandArguments& arguments);
  Json print_board(CommandArguments& arguments);
  Json find_axis(CommandArguments& arguments);
  Json capture_pose(CommandArguments& arguments);
  Json end_poses(CommandArguments& arguments);

  Json start_edit(CommandArguments& arguments);
  Json start_preview(CommandArguments& arguments);
  Json drop_preview(CommandArguments& arguments);
  Json start_set_reference(CommandArguments& arguments);
  Json show_reference(CommandArguments& arguments);
  Json next_part(CommandArguments& arguments);
  Json set_plan(CommandArguments& arguments);
  Json open_plan(CommandArguments& arguments);
  /// Keeps a plan that arrived as text, in the folder and in the state.
  Json keep_plan(const std::string& text);
  Json start_inspect(CommandArguments& arguments);
  Json start_report(CommandArguments& arguments);
  Json set_acceptance(CommandArguments& arguments);
  Json start_measure_arrangement(CommandArguments& arguments);
  Json start_certificate(CommandArguments& arguments);
  /// Writes a page as a PDF file.
  void print_page(const ProjectFolder& project,
                  const std::string& page,
                  const std::filesystem::path& pdf,
                  const Run& run) const;
  Json estimate_export(CommandArguments& arguments);
  Json start_select_component(CommandArguments& arguments);
  Json start_select_like(CommandArguments& arguments);
  Json start_undo(CommandArguments& arguments);
  Json start_redo(CommandArguments& arguments);
  Json start_fit(CommandArguments& arguments);
  Json start_export(CommandArguments& arguments);
  Json start_measure(CommandArguments& arguments);
  Json remove_measurements(CommandArguments& arguments);
  /// Changes what was measured by hand: writes it, and shows it.
  void keep_measurements(const ProjectFolder& project,
                         const std::function<void(std::vector<HandMeasurement>&)>& edit);
  Json start_export_section(CommandArguments& arguments);
  Json start_zip(const ProjectFolder& project);
  /// On the queue's thread: writes an export and shows it.
  void put_export(const ProjectFolder& project,
                  const std::string& name,
                  std::optional<ExportOrigin> origin,
                  const std::function<void(const std::filesystem::path&)>& write,
                  const Run& run);
  Json stop_job(CommandArguments& arguments);

  /// Starts a job. A live preview that runs is stopped first: it holds the devices and the thread.
  Json started(const char* kind, std::function<void(const Run&)> work);
  Json started_change(const CommandKey& key, SurfaceWork work);
  Json started_view(const char* kind, SurfaceWork work);
  Json started_live(const LiveSettings& settings);
  void stop_live();
  /// Drops what was found about a rig that has changed.
  void forget_verdicts();
  /// Reads the rig, its devices and the settings of the capture again.
  void reload_rig(const ProjectFolder& folder);
  /// On the queue's thread: tests the devices of the project's rig.
  void run_device_test(const ProjectFolder& folder, const Run& run);
  /// @errors   Error(Input) when the folder of the open project was deleted
  void require_folder() const;
  /// @errors   Error(Input) while a job runs, other than a live preview and the job `except`
  void require_idle(int except = 0) const;
  /// Whether a job that sets the reference has not finished.
  [[nodiscard]] bool awaits_reference() const;
  // The following are of the queue's thread.
  /// Makes the file that arrived the reference, completely or not at all.
  void keep_reference(const ProjectFolder& project,
                      const ProjectReference& before,
                      ProjectReference wanted);
  /// The surfaces of the project, read again where that failed before.
  ///
  /// @errors   as read_surface_versions
  std::shared_ptr<const SurfaceVersions> versions_of(const ProjectFolder& project);
  /// The current version, read from disk unless it is in memory. `otherwise` is the error without
  /// one.
  const SurfaceModel& model_of(const ProjectFolder& project, const char* otherwise, const Run& run);
  /// Drops the model unless it was read since the present project was opened: the files of one that
  /// was closed may have changed.
  void use_opened();
  /// A change of the surface from its beginning to its end.
  void change_surface(const ProjectFolder& project,
                      const CommandKey& key,
                      const SurfaceWork& work,
                      const Run& run);
  void rebuild_surface(const ProjectFolder& project,
                       const CommandKey& key,
                       const ReconstructOptions& options,
                       const Run& run);
  /// Makes the surface that `write` writes into a new folder the present version.
  void add_version(const ProjectFolder& project,
                   const CommandKey& key,
                   const std::function<void(const std::filesystem::path&)>& write,
                   const Run& run);
  void open_version(const ProjectFolder& project,
                    const CommandKey& key,
                    int number,
                    const Run& run);
  /// The end of each change: writes which versions there are, and shows the model. Returns what to
  /// say when the disk did not confirm it; throws when nothing has changed or when the state on
  /// disk is unknown.
  [[nodiscard]] std::string commit(const ProjectFolder& project,
                                   SurfaceModel next,
                                   SurfaceVersions versions,
                                   const Run& run);
  /// Makes a model the present one. `versions` may be null: they stay.
  void show(std::unique_ptr<SurfaceModel> model,
            std::shared_ptr<const SurfaceVersions> versions) noexcept;
  /// Adds the finer level of the picture, if it is missing and nothing hinders it.
  void refine(const Run& run) noexcept;
  void forget_surface() noexcept;

  void change(const std::function<void(OpenProject&)>& edit);
  void refresh_projects();
  [[nodiscard]] OpenProject opened() const;

  static constexpr std::size_t kMostStations = 360;
  static constexpr std::size_t kMostSetups = 99;

  ServiceOptions options_;
  ProjectLibrary library_;
  RigLibrary rigs_;
  std::function<void()> on_change_;  ///< does not throw
  std::mutex command_mutex_;         ///< one command at a time is accepted
  AnsweredCommands answered_;
  std::mutex measurements_mutex_;  ///< one change of them at a time
  mutable std::mutex mutex_;
  std::vector<ProjectEntry> projects_;
  std::vector<LibraryRig> kept_rigs_;
  DiscardedProjects bin_;
  std::shared_ptr<const DeviceSearch> search_;
  std::optional<OpenProject> project_;
  int openings_ = 0;
  // The following are of the queue's thread.
  int model_opening_ = 0;                ///< whose model it is, see OpenProject::opening
  std::unique_ptr<SurfaceModel> model_;  ///< null until it is read
  int shown_ = 0;                        ///< previews and comparisons so far
  JobQueue queue_;                       ///< last: its thread uses everything else
};

/// Whether devices captured frames of the scan of a project; not so for one that was opened.
[[nodiscard]] bool was_captured(const ProjectFolder& project);

/// Reads the rig of a project, its devices and the settings of the capture into `project`. A
/// damaged file is reported by the step that needs it.
void read_rig_of(const ProjectFolder& folder, OpenProject& project);

}  // namespace frangia
