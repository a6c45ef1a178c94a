#include "frangia/service/service.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/atomic_file.h"
#include "frangia/core/error.h"
#include "frangia/core/make_folder.h"
#include "frangia/core/read_text_file.h"
#include "frangia/devices/device_settings.h"
#include "frangia/files/mesh_formats.h"
#include "frangia/files/write_mesh.h"
#include "frangia/pipeline/reconstruct.h"
#include "frangia/service/internal/command_arguments.h"
#include "frangia/service/internal/state_json.h"
#include "frangia/service/internal/surface_model.h"
#include "frangia/service/simulated_rig.h"

namespace frangia {
namespace {

/// Figures of a reconstruction, as surface.json keeps them.
std::string summary_of(const Reconstruction& result) {
  nlohmann::ordered_json json{{"points", result.points}, {"views", result.views}};
  if (result.registration) {
    json["registration"] = result.registration->text();
    json["rms_before_mm"] = result.registration->rms_before_mm;
    json["rms_after_mm"] = result.registration->rms_after_mm;
  }
  json["untrusted_reason"] = result.untrusted_reason;
  return json.dump();
}

std::vector<ExportEntry> exports_of(const ProjectFolder& project) {
  std::vector<ExportEntry> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(project.exports(), error)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_symlink() || !entry.is_regular_file(error) || is_temporary_file_name(name))
      continue;
    files.push_back({name, static_cast<std::size_t>(entry.file_size(error))});
  }
  std::sort(files.begin(), files.end(), [](const ExportEntry& a, const ExportEntry& b) {
    return a.name < b.name;
  });
  return files;
}

ProjectProgress progress_of(const OpenProject& project) {
  ProjectProgress progress;
  progress.folder = project.folder;
  progress.can_scan = project.can_scan;
  progress.stations = project.stations.size();
  progress.scan_complete = project.scan_complete;
  progress.has_surface = project.surface != nullptr;
  if (project.surface) {
    const auto& steps = project.surface->steps;
    const auto done = static_cast<std::ptrdiff_t>(project.surface->done);
    progress.steps.assign(steps.begin(), steps.begin() + done);
  }
  return progress;
}

bool names_devices(const ProjectFolder& project) {
  std::error_code ignored;
  if (!std::filesystem::exists(project.rig(), ignored)) return false;
  try {
    return !read_device_settings(project.rig()).empty();
  } catch (const Error&) {
    return false;  // the scan says what is wrong with the file
  }
}

}  // namespace

/// The state behind a mutex, and the queue whose one thread changes the surface.
class Service::Implementation {
 public:
  Implementation(ServiceOptions options, std::function<void()> on_change)
      : options_(std::move(options)),
        library_(options_.projects),
        on_change_(std::move(on_change)),
        projects_(library_.list()),
        queue_(on_change_) {}

  void open(const ProjectFolder& folder) {
    require(!queue_.is_busy(), "a task is running; stop it, or let it finish, first");
    OpenProject project;
    project.folder = folder;
    project.can_scan = names_devices(folder) && folder.scan != folder.folder;
    std::error_code ignored;
    project.scan_complete = std::filesystem::exists(folder.scan / "scan.toml", ignored);
    project.stations = read_stations(folder);
    project.exports = exports_of(folder);
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

  std::string command(const std::string& name, const std::string& text) {
    static const std::map<std::string,
                          nlohmann::ordered_json (Implementation::*)(CommandArguments&)>
        kCommands = {{"create-project", &Implementation::create_project},
                     {"open-project", &Implementation::open_project},
                     {"close-project", &Implementation::close_project},
                     {"start-scan", &Implementation::start_scan},
                     {"reconstruct", &Implementation::start_reconstruct},
                     {"edit", &Implementation::start_edit},
                     {"select-component-of", &Implementation::start_select_component},
                     {"undo", &Implementation::start_undo},
                     {"redo", &Implementation::start_redo},
                     {"export", &Implementation::start_export},
                     {"stop-job", &Implementation::stop_job}};
    const auto found = kCommands.find(name);
    require(found != kCommands.end(), "there is no such command");
    CommandArguments arguments(text);
    return (this->*found->second)(arguments).dump();
  }

  [[nodiscard]] std::string state() const {
    ServiceView view;
    {
      const std::lock_guard lock(mutex_);
      view.version = options_.version;
      view.projects = projects_;
      view.project = project_;
    }
    if (view.project && options_.command_lines)
      view.commands = options_.command_lines(progress_of(*view.project));
    view.jobs = queue_.jobs();
    return state_json(view);
  }

  [[nodiscard]] SurfacePtr surface() const {
    const std::lock_guard lock(mutex_);
    return project_ ? project_->surface : nullptr;
  }

  [[nodiscard]] ProjectFolder folder() const {
    const std::lock_guard lock(mutex_);
    require(project_.has_value(), "no project is open; open one, or create one, first");
    return project_->folder;
  }

  [[nodiscard]] std::string cloud(std::size_t station) const {
    ProjectFolder project;
    {
      const std::lock_guard lock(mutex_);
      if (!project_ || station >= project_->stations.size() ||
          !project_->stations[station].has_cloud)
        return {};
      project = project_->folder;
    }
    constexpr std::uint64_t kMostBytes = 16'000'000;
    return read_text_file(project.cloud(station), kMostBytes);
  }

  [[nodiscard]] ExportedFile exported(const std::string& name) const {
    const ProjectFolder project = folder();
    for (const ExportEntry& entry : exports_of(project))
      if (entry.name == name) return {name, project.exports() / name};
    throw Error(ErrorKind::Input, "there is no exported file of this name; export it first");
  }

 private:
  using Json = nlohmann::ordered_json;

  Json create_project(CommandArguments& arguments) {
    const std::string name = arguments.text("name");
    const std::string part = arguments.text_or("part", "bust");
    constexpr std::size_t kUsual = 8;
    const std::size_t stations = arguments.whole_or("stations", kUsual, 1, kMostStations);
    arguments.check_all_read();
    require(!queue_.is_busy(), "a task is running; stop it, or let it finish, first");
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

  Json open_project(CommandArguments& arguments) {
    const std::string name = arguments.text("name");
    arguments.check_all_read();
    open(library_.find(name));
    return Json::object();
  }

  Json close_project(CommandArguments& arguments) {
    arguments.check_all_read();
    require(!queue_.is_busy(), "a task is running; stop it, or let it finish, first");
    {
      const std::lock_guard lock(mutex_);
      project_.reset();
    }
    refresh_projects();
    return Json::object();
  }

  Json start_scan(CommandArguments& arguments) {
    const ProjectFolder project = folder();
    std::vector<ProjectStation> stations;
    bool can_scan = false;
    {
      const std::lock_guard lock(mutex_);
      stations = project_->stations;
      can_scan = project_->can_scan;
    }
    const std::size_t asked =
        arguments.whole_or("stations", stations.empty() ? 8 : stations.size(), 1, kMostStations);
    arguments.check_all_read();
    require(can_scan, "this project has no rig with devices; create one to scan");
    std::error_code ignored;
    const bool begun = std::filesystem::exists(project.scan / "capture", ignored);
    require(!begun || asked == stations.size(),
            "the scan has begun; its number of stations cannot change");
    if (asked != stations.size()) stations = planned_stations(asked);
    return started("scan", [this, project, stations](const Run& run) {
      const CaptureReport report = capture_project(
          project,
          stations,
          options_.capture,
          [this](const std::vector<ProjectStation>& all) {
            change([&](OpenProject& opened) { opened.stations = all; });
          },
          run);
      change([&](OpenProject& opened) { opened.scan_complete = true; });
      refresh_projects();
      run.note(
          fmt::format("{} frames captured, {} already there", report.captured, report.resumed));
    });
  }

  Json start_reconstruct(CommandArguments& arguments) {
    const ProjectFolder project = folder();
    ReconstructOptions options;
    options.fusion.voxel_mm = arguments.positive("voxel_mm").value_or(options.fusion.voxel_mm);
    arguments.check_all_read();
    return started("reconstruct", [this, project, options](const Run& run) {
      const Reconstruction result = reconstruct(read_scan(project.scan, run), options, run);
      run.stage("files");
      make_folder(project.derived);
      std::error_code ignored;
      std::filesystem::remove(project.edits(), ignored);  // they belong to the mesh before
      write_mesh(project.surface(), result.mesh, {}, run);
      AtomicFile summary(project.summary());
      summary.stream() << summary_of(result);
      summary.commit();
      change([&](OpenProject& opened) { opened.summary = summary_of(result); });
      load_surface(project, run);
      if (!result.untrusted_reason.empty())
        run.warn("do not trust this surface: " + result.untrusted_reason);
      refresh_projects();
    });
  }

  Json start_edit(CommandArguments& arguments) {
    const EditStep step{arguments.text("operation"), arguments.text_or("value", "")};
    arguments.check_all_read();
    check_step(step);
    return started_edit(
        [step](SurfaceModel& model, const Run& run) { return model.apply(step, run); });
  }

  Json start_select_component(CommandArguments& arguments) {
    const std::size_t triangle = arguments.whole("triangle", 0, UINT32_MAX);
    arguments.check_all_read();
    return started_edit([triangle](SurfaceModel& model, const Run& run) {
      return model.select_component_of(triangle, run);
    });
  }

  Json start_undo(CommandArguments& arguments) {
    arguments.check_all_read();
    return started_edit([](SurfaceModel& model, const Run&) { return model.undo(); });
  }

  Json start_redo(CommandArguments& arguments) {
    arguments.check_all_read();
    return started_edit([](SurfaceModel& model, const Run&) { return model.redo(); });
  }

  Json start_export(CommandArguments& arguments) {
    const ProjectFolder project = folder();
    const std::string format = arguments.text("format");
    static const std::map<std::string, DxfVariant> kVariants = {{"faces", DxfVariant::Faces},
                                                                {"polyface", DxfVariant::Polyface},
                                                                {"mesh", DxfVariant::Mesh}};
    const auto variant = kVariants.find(arguments.text_or("dxf", "faces"));
    const std::size_t triangles = arguments.whole_or("triangles", 0, 0, UINT32_MAX);
    arguments.check_all_read();
    const std::string name = project.name + "." + format;
    require(format.find('/') == std::string::npos && find_mesh_format("x." + format) != nullptr,
            "there is no such format; choose one of the list");
    require(variant != kVariants.end(), "dxf: is faces, polyface or mesh");
    WriteOptions options;
    options.dxf.variant = variant->second;
    return started("export", [this, project, name, options, triangles](const Run& run) {
      require(model_ != nullptr, "there is no surface to export; reconstruct it first");
      run.stage("files");
      make_folder(project.exports());
      if (triangles > 0 && model_->mesh().triangles.size() > triangles) {
        EditState reduced{.mesh = model_->mesh(), .selection = {}};
        apply_step(reduced, {"decimate-to", std::to_string(triangles)}, run);
        write_mesh(project.exports() / name, reduced.mesh, options, run);
      } else {
        write_mesh(project.exports() / name, model_->mesh(), options, run);
      }
      change([&](OpenProject& opened) { opened.exports = exports_of(project); });
    });
  }

  Json stop_job(CommandArguments& arguments) {
    const std::size_t number = arguments.whole("job", 1, INT32_MAX);
    arguments.check_all_read();
    require(queue_.stop(static_cast<int>(number)), "this task has finished already");
    return Json::object();
  }

  Json started(const char* kind, std::function<void(const Run&)> work) {
    return {{"job", queue_.start(kind, std::move(work))}};
  }

  Json started_edit(std::function<SurfacePtr(SurfaceModel&, const Run&)> work) {
    static_cast<void>(folder());
    return started("edit", [this, work = std::move(work)](const Run& run) {
      require(model_ != nullptr, "there is no surface to edit; reconstruct it first");
      const SurfacePtr surface = work(*model_, run);
      change([&](OpenProject& opened) { opened.surface = surface; });
    });
  }

  /// On the queue's thread.
  void load_surface(const ProjectFolder& project, const Run& run) {
    drop_model();
    model_ = std::make_unique<SurfaceModel>(project, revision_, run);
    change([&](OpenProject& opened) { opened.surface = model_->snapshot(); });
  }

  /// On the queue's thread. The next model counts on, so that no two meshes share a revision.
  void drop_model() {
    if (model_) revision_ = model_->snapshot()->selection_revision;
    model_.reset();
  }

  void change(const std::function<void(OpenProject&)>& edit) {
    {
      const std::lock_guard lock(mutex_);
      if (project_) edit(*project_);
    }
    on_change_();
  }

  void refresh_projects() {
    auto entries = library_.list();
    {
      const std::lock_guard lock(mutex_);
      projects_ = std::move(entries);
    }
    on_change_();
  }

  static constexpr std::size_t kMostStations = 360;

  ServiceOptions options_;
  ProjectLibrary library_;
  std::function<void()> on_change_;
  mutable std::mutex mutex_;
  std::vector<ProjectEntry> projects_;
  std::optional<OpenProject> project_;
  std::unique_ptr<SurfaceModel> model_;  ///< of the queue's thread
  int revision_ = 0;                     ///< of the queue's thread
  JobQueue queue_;                       ///< last: its thread uses everything else
};

Service::Service(ServiceOptions options, std::function<void()> on_change)
    : implementation_(std::make_unique<Implementation>(std::move(options), std::move(on_change))) {}

Service::~Service() = default;

void Service::open_folder(const std::filesystem::path& folder) {
  implementation_->open(project_in(folder));
}

std::string Service::command(const std::string& name, const std::string& arguments) {
  return implementation_->command(name, arguments);
}

std::string Service::state() const {
  return implementation_->state();
}

std::shared_ptr<const std::string> Service::mesh() const {
  const SurfacePtr surface = implementation_->surface();
  return surface ? surface->mesh : nullptr;
}

std::shared_ptr<const std::string> Service::selection() const {
  const SurfacePtr surface = implementation_->surface();
  return surface ? surface->selection : nullptr;
}

std::string Service::cloud(std::size_t station) const {
  return implementation_->cloud(station);
}

ExportedFile Service::exported(const std::string& name) const {
  return implementation_->exported(name);
}

}  // namespace frangia
