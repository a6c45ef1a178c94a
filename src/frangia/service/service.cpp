#include "frangia/service/service.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <nlohmann/json.hpp>

#include "frangia/core/error.h"
#include "frangia/core/read_file.h"
#include "frangia/geometry/pick_surface.h"
#include "frangia/service/encode_arrays.h"
#include "frangia/service/internal/array_packer.h"
#include "frangia/service/internal/command_arguments.h"
#include "frangia/service/internal/implementation.h"

namespace frangia {
namespace {

/// Whether a job has finished; false for number 0.
bool is_over(const std::vector<Job>& jobs, int number) {
  const bool begun = !jobs.empty() && jobs.back().number >= number;
  return number != 0 && begun && std::none_of(jobs.begin(), jobs.end(), [&](const Job& job) {
           return job.number == number &&
                  (job.state == JobState::Waiting || job.state == JobState::Running);
         });
}

}  // namespace

Service::Implementation::Implementation(ServiceOptions options, std::function<void()> on_change)
    : options_(std::move(options)),
      library_(options_.projects),
      rigs_(options_.projects / ".rigs"),
      on_change_([told = std::move(on_change)]() noexcept {
        try {
          told();
        } catch (...) {  // NOLINT(bugprone-empty-catch): listeners get the next change
        }
      }),
      projects_(library_.list()),
      kept_rigs_(rigs_.list()),
      bin_(library_.in_bin()),
      queue_(on_change_) {}

std::string Service::Implementation::command(const std::string& name, const std::string& text) {
  static const std::map<std::string, Json (Implementation::*)(CommandArguments&)> kCommands = {
      {"create-project", &Implementation::create_project},
      {"open-project", &Implementation::open_project},
      {"close-project", &Implementation::close_project},
      {"rename-project", &Implementation::rename_project},
      {"duplicate-project", &Implementation::duplicate_project},
      {"discard-project", &Implementation::discard_project},
      {"take-back-project", &Implementation::take_back_project},
      {"empty-bin", &Implementation::empty_bin},
      {"set-notes", &Implementation::set_notes},
      {"set-thumbnail", &Implementation::set_thumbnail},
      {"measure", &Implementation::start_measure},
      {"remove-measurements", &Implementation::remove_measurements},
      {"open-file", &Implementation::open_file},
      {"set-capture", &Implementation::set_capture},
      {"start-live", &Implementation::start_live},
      {"set-live", &Implementation::set_live},
      {"start-scan", &Implementation::start_scan},
      {"rescan-station", &Implementation::rescan_station},
      {"reconstruct", &Implementation::start_reconstruct},
      {"open-version", &Implementation::start_open_version},
      {"replay-edits", &Implementation::start_replay},
      {"find-devices", &Implementation::start_find_devices},
      {"identify-displays", &Implementation::start_identify},
      {"set-devices", &Implementation::start_set_devices},
      {"test-devices", &Implementation::start_test_devices},
      {"find-exposure", &Implementation::start_find_exposure},
      {"set-rig", &Implementation::set_rig},
      {"restore-rig", &Implementation::restore_rig_before},
      {"keep-rig", &Implementation::keep_rig_as},
      {"discard-rig", &Implementation::discard_rig},
      {"measure-display", &Implementation::start_measure_display},
      {"check-scan", &Implementation::start_check_scan},
      {"start-calibration", &Implementation::start_calibration},
      {"print-board", &Implementation::print_board},
      {"find-axis", &Implementation::find_axis},
      {"capture-pose", &Implementation::capture_pose},
      {"end-poses", &Implementation::end_poses},
      {"edit", &Implementation::start_edit},
      {"preview", &Implementation::start_preview},
      {"drop-preview", &Implementation::drop_preview},
      {"set-reference", &Implementation::start_set_reference},
      {"next-part", &Implementation::next_part},
      {"show-reference", &Implementation::show_reference},
      {"set-plan", &Implementation::set_plan},
      {"open-plan", &Implementation::open_plan},
      {"inspect", &Implementation::start_inspect},
      {"report", &Implementation::start_report},
      {"set-acceptance", &Implementation::set_acceptance},
      {"measure-arrangement", &Implementation::start_measure_arrangement},
      {"certificate", &Implementation::start_certificate},
      {"estimate-export", &Implementation::estimate_export},
      {"select-component-of", &Implementation::start_select_component},
      {"select-like", &Implementation::start_select_like},
      {"undo", &Implementation::start_undo},
      {"redo", &Implementation::start_redo},
      {"fit", &Implementation::start_fit},
      {"export", &Implementation::start_export},
      {"export-section", &Implementation::start_export_section},
      {"stop-job", &Implementation::stop_job}};
  const auto found = kCommands.find(name);
  require(found != kCommands.end(), "there is no such command");
  static const std::set<std::string> kWithoutFolder = {"create-project",
                                                       "open-project",
                                                       "close-project",
                                                       "rename-project",
                                                       "duplicate-project",
                                                       "discard-project",
                                                       "take-back-project",
                                                       "empty-bin",
                                                       "set-notes",
                                                       "find-devices",
                                                       "identify-displays",
                                                       "discard-rig",
                                                       "stop-job"};
  CommandArguments arguments(text, name);
  // A job is stopped at once, whatever another command is at.
  if (name == "stop-job") return stop_job(arguments).dump();
  const std::lock_guard one_at_a_time(command_mutex_);
  Json answer = answer_given(arguments.key());
  if (!answer.is_null()) return answer.dump();
  if (!kWithoutFolder.contains(name)) require_folder();
  answer = (this->*found->second)(arguments);
  {
    const std::lock_guard lock(mutex_);
    answer["revision"] = project_ && project_->versions ? project_->versions->revision : 0;
  }
  answered_.keep(arguments.key(), answer);
  return answer.dump();
}

nlohmann::ordered_json Service::Implementation::answer_given(const CommandKey& key) const {
  if (const Json* known = answered_.find(key)) {
    Json answer = *known;
    answer["repeated"] = true;
    return answer;
  }
  const std::lock_guard lock(mutex_);
  const AnsweredCommand* known =
      project_ && project_->versions ? project_->versions->find(key) : nullptr;
  if (known == nullptr) return {};
  require_same_command(key, known->key);
  return {{"revision", known->revision}, {"repeated", true}};
}

std::string Service::Implementation::state() const {
  ServiceView view;
  view.jobs = queue_.jobs();  // before the project: what a job did is shown when it is over
  {
    const std::lock_guard lock(mutex_);
    view.version = options_.version;
    view.projects = projects_;
    view.rigs = kept_rigs_;
    view.bin = bin_;
    view.project = project_;
    view.search = search_;
  }
  try {
    if (view.project && options_.command_lines)
      view.commands = options_.command_lines(progress_of(*view.project));
  } catch (const Error&) {  // NOLINT(bugprone-empty-catch): a link was put into the project, which
                            // what needs its files refuses
  }
  if (view.project && is_over(view.jobs, view.project->open_job))
    view.project->surface_loading = false;  // it failed, or was stopped
  return state_json(view);
}

SurfacePtr Service::Implementation::surface() const {
  const std::lock_guard lock(mutex_);
  return project_ ? project_->surface : nullptr;
}

ProjectFolder Service::Implementation::folder() const {
  return opened().folder;
}

OpenProject Service::Implementation::opened() const {
  const std::lock_guard lock(mutex_);
  require(project_.has_value(), "no project is open; open one, or create one, first");
  return *project_;
}

std::string Service::Implementation::setup_cloud(std::size_t joined) const {
  const OpenProject project = opened();
  if (!project.surface || !project.versions) return {};
  const SurfaceVersion* version = project.versions->find(project.surface->version);
  if (version == nullptr) return {};
  const auto file = files_of(project.folder, *version).setup_cloud(joined);
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return {};
  constexpr std::uint64_t kMostBytes = 16'000'000;
  return read_text_file(file, kMostBytes);
}
std::string Service::Implementation::residuals() const {
  const auto file = folder().residuals();
  std::error_code ignored;
  require(std::filesystem::exists(file, ignored), "this rig was not calibrated in this project");
  constexpr std::uint64_t kMostBytes = 64'000'000;
  return read_text_file(file, kMostBytes);
}
ExportedFile Service::Implementation::exported(const std::string& name) const {
  const ProjectFolder project = folder();
  for (const ExportEntry& entry : exports_of(project))
    if (entry.name == name)
      return {name,
              project.exports() / name,
              project.open_in_derived(std::filesystem::path("exports") / name)};
  throw Error(ErrorKind::Input, "there is no exported file of this name; export it first");
}
LivePicture Service::Implementation::live_picture(LiveLayer layer, std::uint64_t after) const {
  std::shared_ptr<LivePreview> live;
  std::shared_ptr<CalibrationWizard> wizard;
  {
    const std::lock_guard lock(mutex_);
    if (!project_ || layer == LiveLayer::None) return {};
    live = project_->live;
    wizard = project_->wizard;
  }
  const auto snapshot = live ? live->snapshot() : wizard ? wizard->snapshot() : nullptr;
  if (!snapshot || snapshot->revision == after) return {};
  return {snapshot->revision,
          std::make_shared<const std::string>(
              encode_live(*snapshot, layer, live ? live->rig() : Rig{}))};
}

nlohmann::ordered_json Service::Implementation::stop_job(CommandArguments& arguments) {
  const std::size_t number = arguments.whole("job", 1, INT32_MAX);
  arguments.check_all_read();
  require(queue_.stop(static_cast<int>(number)), "this task has finished already");
  return Json::object();
}
nlohmann::ordered_json Service::Implementation::started(const char* kind,
                                                        std::function<void(const Run&)> work) {
  stop_live();
  return {{"job", queue_.start(kind, std::move(work))}};
}

void Service::Implementation::stop_live() {
  for (const Job& job : queue_.jobs())
    if (job.kind == "live") queue_.stop(job.number);
}

void Service::Implementation::change(const std::function<void(OpenProject&)>& edit) {
  {
    const std::lock_guard lock(mutex_);
    if (project_) edit(*project_);
  }
  on_change_();
}
void Service::Implementation::refresh_projects() {
  auto entries = library_.list();
  auto rigs = rigs_.list();
  auto bin = library_.in_bin();
  {
    const std::lock_guard lock(mutex_);
    projects_ = std::move(entries);
    kept_rigs_ = std::move(rigs);
    bin_ = std::move(bin);
  }
  on_change_();
}
Service::Service(ServiceOptions options, std::function<void()> on_change)
    : implementation_(std::make_unique<Implementation>(std::move(options), std::move(on_change))) {}

Service::~Service() = default;

void Service::open_folder(const std::filesystem::path& folder) {
  implementation_->open_folder(folder);
}

std::string Service::command(const std::string& name, const std::string& arguments) {
  return implementation_->command(name, arguments);
}

std::string Service::state() const {
  return implementation_->state();
}

std::string Service::mesh() const {
  const SurfacePtr surface = implementation_->surface();
  return surface ? encode_mesh(surface->picture->mesh(), surface->mesh_revision) : std::string();
}

std::string Service::level(std::size_t level) const {
  const SurfacePtr surface = implementation_->surface();
  return surface ? surface->picture->packed_level(level) : std::string();
}

std::string Service::reference_picture() const {
  const PicturePtr picture = implementation_->reference_picture();
  return picture ? picture->packed_level(0) : std::string();
}

std::string Service::selection() const {
  const SurfacePtr surface = implementation_->surface();
  return surface ? encode_selection(*surface->selection, surface->selection_revision)
                 : std::string();
}

std::string Service::selection(std::size_t level) const {
  const SurfacePtr surface = implementation_->surface();
  return surface ? surface->picture->packed_selection(
                       level, *surface->selection, surface->selection_revision)
                 : std::string();
}

std::string Service::preview() const {
  const SurfacePtr surface = implementation_->surface();
  return surface && surface->preview ? *surface->preview->arrays : std::string();
}

std::string Service::deviations(std::size_t level) const {
  const SurfacePtr surface = implementation_->surface();
  if (!surface || !surface->inspection || !surface->inspection->found.surface ||
      level >= surface->picture->levels().size())
    return {};
  const auto values = values_of_level(surface->inspection->found.surface->deviations.deviation_mm,
                                      *surface->picture->levels()[level]);
  ArrayPacker packer;
  packer.add("deviation_mm", "float32", values.data(), values.size());
  packer.set_values({{"revision", surface->inspection->revision}});
  return packer.pack();
}

void Service::add_to_reference(std::size_t offset, const std::string& bytes) {
  implementation_->add_to_reference(offset, bytes);
}

std::string Service::pick(const std::string& ray_json) const {
  CommandArguments arguments(ray_json);
  const auto vector = [&](const char* key) {
    const auto values = arguments.numbers(key, 3);
    return Eigen::Vector3d(values[0], values[1], values[2]);
  };
  PickRay ray{.eye_mm = vector("eye"), .direction = vector("direction")};
  if (const auto section = arguments.numbers_or_none("section", 4); !section.empty()) {
    ray.section_normal = {section[0], section[1], section[2]};
    ray.section_offset_mm = section[3];
  }
  const bool of_reference = arguments.flag("reference");
  arguments.check_all_read();
  const SurfacePtr surface = implementation_->surface();
  require(surface != nullptr, "there is no surface to point at; reconstruct it first");
  const PicturePtr picture = of_reference ? implementation_->reference_picture() : surface->picture;
  require(picture != nullptr, "the reference is not shown yet; show it first");
  const auto picked = pick_surface(picture->mesh(), ray);
  nlohmann::ordered_json json{{"mesh_revision", surface->mesh_revision}, {"hit", nullptr}};
  if (picked) {
    const Eigen::Vector3d& p = picked->point_mm;
    json["hit"] = {
        {"point_mm", {p.x(), p.y(), p.z()}}, {"triangle", picked->triangle}, {"sigma_mm", nullptr}};
    if (std::isfinite(picked->sigma_mm)) json["hit"]["sigma_mm"] = picked->sigma_mm;
    if (of_reference) json["hit"]["face"] = implementation_->reference_face(picked->triangle);
  }
  return json.dump();
}

std::string Service::section(const std::string& plane_json) const {
  return implementation_->section(plane_json);
}

std::string Service::cloud(std::size_t station) const {
  return implementation_->cloud(station);
}

std::string Service::grown_surface() const {
  return implementation_->grown_surface();
}

std::string Service::setup_cloud(std::size_t joined) const {
  return implementation_->setup_cloud(joined);
}

LivePicture Service::live_picture(LiveLayer layer, std::uint64_t after) const {
  return implementation_->live_picture(layer, after);
}

std::string Service::thumbnail(const std::string& name) const {
  return implementation_->thumbnail(name);
}
std::string Service::residuals() const {
  return implementation_->residuals();
}

ExportedFile Service::exported(const std::string& name) const {
  return implementation_->exported(name);
}

}  // namespace frangia
