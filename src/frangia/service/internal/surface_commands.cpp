#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/editor/step_like.h"
#include "frangia/service/internal/implementation.h"
#include "frangia/service/internal/project_names.h"
#include "frangia/service/internal/surface_build.h"

namespace frangia {
namespace {

/// A file or folder that is removed unless what names it was committed, or may have been.
class Uncommitted {
 public:
  explicit Uncommitted(std::filesystem::path path) : path_(std::move(path)) {}
  Uncommitted(const Uncommitted&) = delete;
  Uncommitted& operator=(const Uncommitted&) = delete;
  Uncommitted(Uncommitted&&) = delete;
  Uncommitted& operator=(Uncommitted&&) = delete;
  ~Uncommitted() {
    std::error_code ignored;
    if (!kept_) std::filesystem::remove_all(path_, ignored);
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  void keep() noexcept { kept_ = true; }

 private:
  std::filesystem::path path_;
  bool kept_ = false;
};

[[noreturn]] void say_unconfirmed(const std::string& doubt) {
  throw Error(ErrorKind::File, doubt);
}

}  // namespace

nlohmann::ordered_json Service::Implementation::started_change(const CommandKey& key,
                                                               SurfaceWork work) {
  return started("edit", [this, project = folder(), key, work = std::move(work)](const Run& run) {
    change_surface(project, key, work, run);
  });
}

nlohmann::ordered_json Service::Implementation::started_view(const char* kind, SurfaceWork work) {
  return started(kind, [this, project = folder(), work = std::move(work)](const Run& run) {
    const SurfaceModel& model =
        model_of(project, "there is no surface yet; reconstruct it first", run);
    show(std::make_unique<SurfaceModel>(work(model, ++shown_, run)), nullptr);
    refine(run);
  });
}

nlohmann::ordered_json Service::Implementation::start_reconstruct(CommandArguments& arguments) {
  ReconstructOptions options;
  const BuildSettings settings{
      .voxel_mm = arguments.positive("voxel_mm").value_or(0.0),
      .watertight = arguments.flag("watertight"),
      .max_triangles = arguments.whole_or("max_triangles", 0, kFewestTriangles, kMostTriangles)};
  arguments.check_all_read();
  if (settings.voxel_mm > 0.0) options.fusion.voxel_mm = settings.voxel_mm;
  options.finish.watertight = settings.watertight;
  options.finish.max_triangles = settings.max_triangles;
  change([&](OpenProject& now) { now.build = settings; });
  options.decode = decode_options_of(opened().capture);
  options.keep_points_of_setups = kPointsOfSetup;
  return started(
      "reconstruct",
      [this, project = folder(), options, key = arguments.key()](const Run& run) mutable {
        options.decoded = opened().decoded;
        rebuild_surface(project, key, options, run);
      });
}

/// Shows an earlier surface with its edits, or reads the present one where that was stopped.
nlohmann::ordered_json Service::Implementation::start_open_version(CommandArguments& arguments) {
  const auto number =
      static_cast<int>(arguments.whole("version", 1, SurfaceVersions::kMostVersions));
  arguments.check_all_read();
  return started("open", [this, project = folder(), number, key = arguments.key()](const Run& run) {
    open_version(project, key, number, run);
  });
}

/// Applies the edits of another version to the present one, all or none.
nlohmann::ordered_json Service::Implementation::start_replay(CommandArguments& arguments) {
  const auto number =
      static_cast<int>(arguments.whole("version", 1, SurfaceVersions::kMostVersions));
  arguments.check_all_read();
  const ProjectFolder project = folder();
  return started_change(
      arguments.key(),
      [this, project, number](const SurfaceModel& model, int revision, const Run& run) {
        const auto versions = versions_of(project);
        const SurfaceVersion* from = versions->find(number);
        require(from != nullptr, "version: there is no surface of this number");
        require(number != versions->current, "version: these edits are of the surface itself");
        require(from->done > 0, "version: this surface has no edits");
        EditScript script = read_edit_script(files_of(project, *from).edits);
        script.steps.resize(script.done);
        return model.replayed(script.steps, revision, run);
      });
}

std::shared_ptr<const SurfaceVersions> Service::Implementation::versions_of(
    const ProjectFolder& project) {
  {
    const std::lock_guard lock(mutex_);
    if (project_ && project_->versions) return project_->versions;
  }
  auto read = std::make_shared<const SurfaceVersions>(read_surface_versions(project));
  change([&](OpenProject& now) { now.versions = read; });
  return read;
}

void Service::Implementation::use_opened() {
  int opening = 0;
  {
    const std::lock_guard lock(mutex_);
    if (project_) opening = project_->opening;
  }
  if (model_opening_ == opening) return;
  model_.reset();
  model_opening_ = opening;
}

const SurfaceModel& Service::Implementation::model_of(const ProjectFolder& project,
                                                      const char* otherwise,
                                                      const Run& run) {
  use_opened();
  const auto versions = versions_of(project);
  const SurfaceVersion* current = versions->find(versions->current);
  require(current != nullptr, otherwise);
  if (model_) return *model_;
  show(std::make_unique<SurfaceModel>(
           files_of(project, *current), current->number, versions->revision, run),
       versions);
  return *model_;
}

void Service::Implementation::change_surface(const ProjectFolder& project,
                                             const CommandKey& key,
                                             const SurfaceWork& work,
                                             const Run& run) {
  const SurfaceModel& now =
      model_of(project, "there is no surface to edit; reconstruct it first", run);
  SurfaceVersions versions = *versions_of(project);
  if (versions.find(key) != nullptr) return;
  ++versions.revision;
  SurfaceModel next = work(now, versions.revision, run);
  SurfaceVersion& version = *versions.find(versions.current);
  const auto before = edits_file(project, version, version.edits);  // there need not be one
  const EditScript script = next.script();
  version.edits = versions.revision;
  version.steps = script.steps.size();
  version.done = script.done;
  versions.answer(key);
  run.stage("files");
  Uncommitted edits(edits_file(project, version, versions.revision));
  write_edit_script(edits.path(), script, Durability::Synced);
  std::string doubt;
  try {
    doubt = commit(project, std::move(next), std::move(versions), run);
  } catch (const SurfaceUnknown&) {
    edits.keep();
    throw;
  }
  edits.keep();
  refine(run);
  if (!doubt.empty()) say_unconfirmed(doubt);
  std::error_code ignored;
  std::filesystem::remove(before, ignored);
}

void Service::Implementation::open_version(const ProjectFolder& project,
                                           const CommandKey& key,
                                           int number,
                                           const Run& run) {
  use_opened();
  SurfaceVersions versions = *versions_of(project);
  const SurfaceVersion* version = versions.find(number);
  require(version != nullptr, "version: there is no surface of this number");
  if (number == versions.current || versions.find(key) != nullptr) {
    static_cast<void>(model_of(project, "there is no surface", run));
    return refine(run);
  }
  ++versions.revision;
  versions.current = number;
  versions.answer(key);
  SurfaceModel next(files_of(project, *version), number, versions.revision, run);
  run.stage("files");
  const std::string doubt = commit(project, std::move(next), std::move(versions), run);
  refine(run);
  if (!doubt.empty()) say_unconfirmed(doubt);
}

void Service::Implementation::rebuild_surface(const ProjectFolder& project,
                                              const CommandKey& key,
                                              const ReconstructOptions& options,
                                              const Run& run) {
  std::string untrusted;
  add_version(
      project,
      key,
      [&](const std::filesystem::path& folder) {
        std::vector<std::string> warnings;
        Run listening = run;
        listening.on_warning = [&](const std::string& sentence) {
          warnings.push_back(sentence);
          run.warn(sentence);
        };
        const Reconstruction result =
            reconstruct(read_scan(project.scan, listening), options, listening);
        run.stage("files");
        write_surface_build(folder, result, warnings, run);
        untrusted = result.untrusted_reason;
      },
      run);
  change([](OpenProject& now) { now.grown.reset(); });
  if (!untrusted.empty()) run.warn(fmt::format("do not trust this surface: {}", untrusted));
}

void Service::Implementation::add_version(
    const ProjectFolder& project,
    const CommandKey& key,
    const std::function<void(const std::filesystem::path&)>& write,
    const Run& run) {
  use_opened();
  SurfaceVersions versions = *versions_of(project);
  if (versions.find(key) != nullptr) return;
  Uncommitted fresh(new_version_folder(project));
  write(fresh.path());
  SurfaceVersion version{.number = next_version_number(project, versions),
                         .previous = versions.current,
                         .built_s = seconds_since_1970()};
  ++versions.revision;
  // Read as it will be read from now on: what cannot be read is not committed.
  SurfaceModel next({fresh.path(), {}}, version.number, versions.revision, run);
  versions.current = version.number;
  versions.all.push_back(version);
  versions.answer(key);
  Uncommitted named(files_of(project, version).folder);
  std::error_code error;
  std::filesystem::rename(fresh.path(), named.path(), error);
  if (error) {
    throw Error(ErrorKind::File,
                fmt::format("{}: cannot be renamed: {}", fresh.path().string(), error.message()));
  }
  sync_to_disk(folder_of(named.path()));
  std::string doubt;
  try {
    doubt = commit(project, std::move(next), std::move(versions), run);
  } catch (const SurfaceUnknown&) {
    named.keep();
    throw;
  }
  named.keep();
  refine(run);
  try {
    refresh_projects();
  } catch (const std::exception&) {  // NOLINT(bugprone-empty-catch): the list is of others, too
  }
  if (!doubt.empty()) say_unconfirmed(doubt);
}

std::string Service::Implementation::commit(const ProjectFolder& project,
                                            SurfaceModel next,
                                            SurfaceVersions versions,
                                            const Run& run) {
  auto model = std::make_unique<SurfaceModel>(std::move(next));
  const auto kept = std::make_shared<const SurfaceVersions>(std::move(versions));
  run.check();  // the last one: a stop from here on comes too late, and the change is done
  std::string doubt;
  try {
    doubt = commit_surface_versions(project, *kept);
  } catch (const SurfaceUnknown&) {
    forget_surface();
    throw;
  }
  show(std::move(model), kept);
  queue_.set_revision(kept->revision);
  return doubt;
}

void Service::Implementation::show(std::unique_ptr<SurfaceModel> model,
                                   std::shared_ptr<const SurfaceVersions> versions) noexcept {
  model_ = std::move(model);
  {
    const std::lock_guard lock(mutex_);
    if (project_) {
      project_->surface = model_->snapshot();
      project_->surface_loading = false;
      if (versions) project_->versions = std::move(versions);
    }
  }
  on_change_();
}

void Service::Implementation::refine(const Run& run) noexcept {
  try {
    if (model_ && model_->is_coarse())
      show(std::make_unique<SurfaceModel>(model_->refined(run)), nullptr);
  } catch (const std::exception&) {  // NOLINT(bugprone-empty-catch): the coarser level is shown
  }
}

void Service::Implementation::forget_surface() noexcept {
  model_.reset();
  {
    const std::lock_guard lock(mutex_);
    if (project_) {
      project_->surface.reset();
      project_->versions.reset();
      project_->surface_loading = false;
    }
  }
  on_change_();
}

nlohmann::ordered_json Service::Implementation::start_edit(CommandArguments& arguments) {
  const EditStep step{arguments.text("operation"), arguments.text_or("value", "")};
  arguments.check_all_read();
  check_step(step);
  return started_change(arguments.key(),
                        [step](const SurfaceModel& model, int revision, const Run& run) {
                          return model.applied(step, revision, run);
                        });
}
nlohmann::ordered_json Service::Implementation::start_preview(CommandArguments& arguments) {
  const EditStep step{arguments.text("operation"), arguments.text_or("value", "")};
  arguments.check_all_read();
  check_step(step);
  return started_view("preview", [step](const SurfaceModel& model, int count, const Run& run) {
    return model.with_preview(step, count, run);
  });
}
nlohmann::ordered_json Service::Implementation::drop_preview(CommandArguments& arguments) {
  arguments.check_all_read();
  return started_view("preview", [](const SurfaceModel& model, int, const Run&) {
    return model.without_preview();
  });
}
nlohmann::ordered_json Service::Implementation::start_select_component(
    CommandArguments& arguments) {
  const std::size_t triangle = arguments.whole("triangle", 0, UINT32_MAX);
  arguments.check_all_read();
  return started_change(arguments.key(),
                        [triangle](const SurfaceModel& model, int revision, const Run& run) {
                          return model.with_component_of(triangle, revision, run);
                        });
}
nlohmann::ordered_json Service::Implementation::start_select_like(CommandArguments& arguments) {
  const std::size_t triangle = arguments.whole("triangle", 0, UINT32_MAX);
  const auto likeness = arguments.named<Likeness>("by");
  arguments.check_all_read();
  return started_change(
      arguments.key(),
      [triangle, likeness](const SurfaceModel& model, int revision, const Run& run) {
        return model.applied(step_like(model.mesh(), triangle, likeness), revision, run);
      });
}
nlohmann::ordered_json Service::Implementation::start_undo(CommandArguments& arguments) {
  arguments.check_all_read();
  return started_change(arguments.key(),
                        [](const SurfaceModel& model, int revision, const Run& run) {
                          return model.undone(revision, run);
                        });
}
nlohmann::ordered_json Service::Implementation::start_redo(CommandArguments& arguments) {
  arguments.check_all_read();
  return started_change(arguments.key(),
                        [](const SurfaceModel& model, int revision, const Run& run) {
                          return model.redone(revision, run);
                        });
}
nlohmann::ordered_json Service::Implementation::start_fit(CommandArguments& arguments) {
  const std::string kind = arguments.text("kind");
  arguments.check_all_read();
  require(kind == "plane" || kind == "cylinder" || kind == "sphere",
          "kind: is plane, cylinder or sphere");
  return started_view("edit", [kind](const SurfaceModel& model, int, const Run& run) {
    return model.with_fit(kind, run);
  });
}

}  // namespace frangia
