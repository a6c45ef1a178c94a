#include "frangia/service/internal/state_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/angles.h"
#include "frangia/inspection/write_inspection_plan.h"
#include "frangia/phase/algorithm/published_algorithms.h"
#include "frangia/service/example_rigs.h"
#include "frangia/service/internal/rig_json.h"
#include "frangia/service/internal/shown_inspection.h"
#include "frangia/simulate/parts.h"

namespace frangia {
namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

Json json_of_fit(const SurfaceFit& fit) {
  const auto vector = [](const Eigen::Vector3d& v) { return Json{v.x(), v.y(), v.z()}; };
  return {{"kind", fit.kind},
          {"center_mm", vector(fit.center_mm)},
          {"axis", vector(fit.axis)},
          {"diameter_mm", number_or_null(fit.diameter_mm)},
          {"u95_mm", number_or_null(fit.u95_mm)},
          {"rms_mm", fit.rms_mm},
          {"form_mm", fit.form_mm},
          {"points", fit.points}};
}

Json json_of_change(const StepChange& change) {
  return {{"triangles", change.triangles},
          {"holes", change.holes},
          {"components", change.components},
          {"moved", change.moved},
          {"selected", change.selected}};
}

/// The surface of a project as docs/service-api.md describes it.
nlohmann::ordered_json json_of_surface(const SurfaceSnapshot& surface) {
  const std::string& summary = *surface.summary;
  Json json{{"version", surface.version},
            {"mesh", mesh_name(surface)},
            {"mesh_revision", surface.mesh_revision},
            {"selection_revision", surface.selection_revision},
            {"vertices", surface.vertices},
            {"triangles", surface.triangles},
            {"selected", surface.selected},
            {"components", surface.components},
            {"sigma_mm",
             {{"combined", number_or_null(surface.sigma.combined_mm)},
              {"noise", number_or_null(surface.sigma.noise_mm)},
              {"systematic", number_or_null(surface.sigma.systematic_mm)}}},
            {"hole_count", surface.hole_count}};
  json["levels"] = Json::array();
  for (const auto& level : surface.picture->levels()) {
    json["levels"].push_back(
        {{"triangles", level->exact ? surface.triangles : level->triangles.size()},
         {"error_mm", level->error_mm}});
  }
  json["holes"] = Json::array();
  for (const SurfaceHole& hole : surface.holes) {
    json["holes"].push_back(
        {{"number", hole.number},
         {"size_mm", hole.size_mm},
         {"length_mm", hole.length_mm},
         {"center_mm", {hole.center_mm.x(), hole.center_mm.y(), hole.center_mm.z()}}});
  }
  json["steps"] = Json::array();
  for (std::size_t i = 0; i < surface.steps.size(); ++i) {
    const EditStep& step = surface.steps[i];
    json["steps"].push_back({{"operation", step.operation},
                             {"value", step.value},
                             {"change", json_of_change(surface.changes.at(i))}});
  }
  json["preview"] = nullptr;
  if (surface.preview) {
    const SurfacePreview& preview = *surface.preview;
    json["preview"] = {{"operation", preview.step.operation},
                       {"value", preview.step.value},
                       {"change", json_of_change(preview.change)},
                       {"revision", preview.revision}};
  }
  json["comparison"] = surface.inspection ? json_of_comparison(*surface.inspection) : Json();
  json["inspection"] = surface.inspection ? json_of_inspection(*surface.inspection) : Json();
  json["steps_done"] = surface.done;
  json["fits"] = Json::array();
  for (const SurfaceFit& fit : surface.fits)
    json["fits"].push_back(json_of_fit(fit));
  json["summary"] = summary.empty() ? Json() : Json::parse(summary, nullptr, false);
  if (json["summary"].is_discarded()) json["summary"] = Json();
  return json;
}

using Json = nlohmann::ordered_json;

Json json_of_job(const Job& job) {
  Json json{{"number", job.number},
            {"kind", job.kind},
            {"state", name_of(job.state)},
            {"progress", job.progress},
            {"stage", job.stage},
            {"error", job.error},
            {"seconds", job.seconds},
            {"revision", job.revision ? Json(*job.revision) : Json()}};
  json["log"] = Json::array();
  constexpr std::size_t kShown = 40;
  for (std::size_t i = job.log.size() > kShown ? job.log.size() - kShown : 0; i < job.log.size();
       ++i)
    json["log"].push_back({{"warning", job.log[i].warning}, {"sentence", job.log[i].sentence}});
  return json;
}

Json json_of_stations(const std::vector<ProjectStation>& stations) {
  Json all = Json::array();
  for (const ProjectStation& station : stations)
    all.push_back(json_of(station));
  return all;
}

Json json_of_live(const LivePreview& live) {
  const LiveSettings settings = live.settings();
  return {{"pattern", name_of(settings.pattern)}, {"table_deg", deg_from_rad(settings.table_rad)}};
}

Json json_of_capture(const CaptureSettings& settings) {
  return {{"exposure_ms", settings.camera.exposure_ms},
          {"gain_db", settings.camera.gain_db},
          {"black_level_counts", settings.camera.black_level_counts},
          {"exposures_ms", settings.exposures_ms},
          {"shifts", settings.shifts},
          {"algorithm", settings.algorithm}};
}

Json json_of_versions(const SurfaceVersions& versions) {
  Json all = Json::array();
  for (const SurfaceVersion& version : versions.all) {
    all.push_back({{"number", version.number},
                   {"previous", version.previous},
                   {"built_s", version.built_s},
                   {"steps", version.steps},
                   {"steps_done", version.done}});
  }
  return all;
}

Json json_of_project(const OpenProject& project, const CommandLines& commands) {
  Json json{{"name", project.folder.name},
            {"can_scan", project.can_scan},
            {"scan_begun", project.scan_begun},
            {"scan_complete", project.scan_complete},
            {"capture", json_of_capture(project.capture)},
            {"rig", project.rig ? json_of_rig(*project.rig) : Json()},
            {"rig_fault", project.rig_fault},
            {"rig_begun", project.start.has_value()},
            {"rig_adjustable", is_adjustable(project)},
            {"kept_rigs", json_of_kept(project.kept_rigs)},
            {"check", project.check ? json_of_check(*project.check) : Json()},
            {"display", project.display ? json_of_display(*project.display) : Json()},
            {"residuals_s", project.residuals_s},
            {"devices", json_of_devices(project.devices)},
            {"live", project.live ? json_of_live(*project.live) : Json()},
            {"calibration", project.wizard ? json_of_wizard(project.wizard->state()) : Json()},
            {"axis", project.axis ? json_of_axis(*project.axis) : Json()},
            {"axis_fault", project.axis_fault},
            {"table_angle",
             project.unknown_angle
                 ? Json{{"last_deg",
                         number_or_null(project.unknown_angle->last_deg().value_or(kMissing))}}
                 : Json()},
            {"stations", json_of_stations(project.stations)},
            {"grown",
             project.grown ? Json{{"views", project.grown->views},
                                  {"triangles", project.grown->triangles},
                                  {"revision", project.grown->revision}}
                           : Json()},
            {"surface_loading", project.surface_loading},
            {"surface", project.surface ? json_of_surface(*project.surface) : Json()}};
  if (project.surface && project.surface->inspection)
    json["surface"]["inspection"]["current"] = has_current_inspection(project);
  const SurfaceVersions none;
  const SurfaceVersions& versions = project.versions ? *project.versions : none;
  json["revision"] = versions.revision;
  json["current_version"] = versions.current;
  json["versions"] = json_of_versions(versions);
  json["exports"] = Json::array();
  for (const ExportEntry& file : project.exports) {
    json["exports"].push_back({{"name", file.name},
                               {"bytes", file.bytes},
                               {"version", file.origin ? Json(file.origin->version) : Json()},
                               {"revision", file.origin ? Json(file.origin->revision) : Json()}});
  }
  json["measurements"] = json_of(project.measurements);
  json["series"] = json_of(project.series);
  json["acceptance"] = project.acceptance ? json_of(*project.acceptance) : Json();
  json["reference"] = project.reference.name.empty()
                          ? Json()
                          : Json{{"name", project.reference.name},
                                 {"format", project.reference.format},
                                 {"shown", project.reference_picture != nullptr}};
  json["plan"] = project.plan ? Json::parse(inspection_plan_json(*project.plan, {})) : Json();
  json["plan_fault"] = project.plan_fault;
  json["commands"] = Json::object();
  for (const auto& [step, words] : commands)
    json["commands"][step] = words;
  return json;
}

}  // namespace

ProjectProgress progress_of(const OpenProject& project) {
  ProjectProgress progress;
  progress.folder = project.folder;
  progress.can_scan = project.can_scan;
  progress.setup = present_setup(project.stations);
  progress.stations = static_cast<std::size_t>(std::count_if(
      project.stations.begin(), project.stations.end(), [&](const ProjectStation& station) {
        return station.setup == progress.setup;
      }));
  progress.scan_complete = project.scan_complete;
  progress.capture = project.capture;
  progress.build = project.build;
  if (project.wizard) {
    const WizardState state = project.wizard->state();
    if (state.board.columns > 0) {  // otherwise it has not said yet which it is
      progress.calibration = {
          project.wizard->folder(), state.board, state.wanted, !state.verdict.grade.empty()};
    }
  }
  progress.has_surface = project.surface != nullptr;
  if (project.surface) {
    if (project.versions) {
      if (const SurfaceVersion* version = project.versions->find(project.surface->version))
        progress.surface = files_of(project.folder, *version).surface();
    }
    const auto& steps = project.surface->steps;
    const auto done = static_cast<std::ptrdiff_t>(project.surface->done);
    progress.steps.assign(steps.begin(), steps.begin() + done);
    if (const auto& shown = project.surface->inspection) {
      const ToleranceLimits limits = shown->asked.plan.tolerance();
      const auto& alignment = shown->found.alignment;
      progress.inspection = {project.plan ? project.folder.plan() : std::filesystem::path(),
                             shown->asked.plan.reference,
                             shown->asked.scan ? project.folder.scan : std::filesystem::path(),
                             shown->asked.plan.align == "best-fit",
                             project.plan && project.plan->start > 0,
                             std::max<std::size_t>(shown->asked.plan.start, 1),
                             alignment ? alignment->alternatives.size() : 0,
                             limits.lower,
                             limits.upper};
    }
  }
  return progress;
}

std::string state_json(const ServiceView& view) {
  Json json{{"version", view.version}};
  json["parts"] = part_names();
  json["algorithms"] = Json::array();
  for (const PublishedAlgorithm& algorithm : published_algorithms()) {
    json["algorithms"].push_back(
        {{"name", algorithm.name}, {"frames", describe_frames(algorithm)}});
  }
  json["examples"] = Json::array();
  for (const ExampleRig& example : example_rigs())
    json["examples"].push_back({{"name", example.name}, {"description", description_of(example)}});
  json["search"] = view.search ? json_of_search(*view.search) : Json();
  json["rigs"] = Json::array();
  for (const LibraryRig& rig : view.rigs) {
    Json one{{"name", rig.name}, {"kept_s", rig.kept_s}};
    one.update(json_of_figures(rig.figures));
    json["rigs"].push_back(one);
  }
  json["projects"] = Json::array();
  for (const ProjectEntry& entry : view.projects) {
    json["projects"].push_back({{"name", entry.name},
                                {"modified_s", entry.modified_s},
                                {"scanned", entry.scanned},
                                {"has_surface", entry.has_surface},
                                {"thumbnail_s", entry.thumbnail_s},
                                {"notes", entry.notes}});
  }
  json["discarded"] = view.bin.names;
  json["discarded_bytes"] = view.bin.bytes;
  json["project"] = view.project ? json_of_project(*view.project, view.commands) : Json();
  json["jobs"] = Json::array();
  for (const Job& job : view.jobs)
    json["jobs"].push_back(json_of_job(job));
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

nlohmann::ordered_json json_of(const ProjectStation& station) {
  return {{"angle_deg", station.angle_deg},
          {"setup", station.setup},
          {"state", name_of(station.state)},
          {"verdict", station.verdict},
          {"good", station.good},
          {"contrast", station.contrast},
          {"saturated", station.saturated},
          {"points", station.points},
          {"has_cloud", station.has_cloud}};
}

ProjectStation station_from(const nlohmann::json& json) {
  ProjectStation station;
  station.angle_deg = json.at("angle_deg").get<double>();
  station.setup = json.value("setup", 0);  // not in files of earlier versions
  const auto state = json.at("state").get<std::string>();
  if (state == "done") station.state = StationState::Done;
  if (state == "skipped") station.state = StationState::Skipped;
  station.verdict = json.at("verdict").get<std::string>();
  station.good = json.at("good").get<bool>();
  station.contrast = json.at("contrast").get<double>();
  station.saturated = json.at("saturated").get<double>();
  station.points = json.at("points").get<std::size_t>();
  station.has_cloud = json.at("has_cloud").get<bool>();
  return station;
}

}  // namespace frangia
