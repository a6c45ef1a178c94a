#include "frangia/service/internal/state_json.h"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/simulate/parts.h"

namespace frangia {
namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

Json json_of_job(const Job& job) {
  Json json{{"number", job.number},
            {"kind", job.kind},
            {"state", name_of(job.state)},
            {"progress", job.progress},
            {"stage", job.stage},
            {"error", job.error},
            {"seconds", job.seconds}};
  json["log"] = Json::array();
  constexpr std::size_t kShown = 40;
  for (std::size_t i = job.log.size() > kShown ? job.log.size() - kShown : 0; i < job.log.size();
       ++i)
    json["log"].push_back({{"warning", job.log[i].warning}, {"sentence", job.log[i].sentence}});
  return json;
}

Json json_of_stations(const std::vector<ProjectStation>& stations) {
  Json all = Json::array();
  for (const ProjectStation& station : stations) {
    all.push_back({{"angle_deg", station.angle_deg},
                   {"state", name_of(station.state)},
                   {"verdict", station.verdict},
                   {"good", station.good},
                   {"contrast", station.contrast},
                   {"saturated", station.saturated},
                   {"points", station.points},
                   {"has_cloud", station.has_cloud}});
  }
  return all;
}

Json json_of_surface(const SurfaceSnapshot& surface, const std::string& summary) {
  Json json{{"mesh_revision", surface.mesh_revision},
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
  json["holes"] = Json::array();
  for (const SurfaceHole& hole : surface.holes) {
    json["holes"].push_back(
        {{"number", hole.number},
         {"size_mm", hole.size_mm},
         {"length_mm", hole.length_mm},
         {"center_mm", {hole.center_mm.x(), hole.center_mm.y(), hole.center_mm.z()}}});
  }
  json["steps"] = Json::array();
  for (const EditStep& step : surface.steps)
    json["steps"].push_back({{"operation", step.operation}, {"value", step.value}});
  json["steps_done"] = surface.done;
  json["summary"] = summary.empty() ? Json() : Json::parse(summary, nullptr, false);
  if (json["summary"].is_discarded()) json["summary"] = Json();
  return json;
}

Json json_of_project(const OpenProject& project, const CommandLines& commands) {
  Json json{
      {"name", project.folder.name},
      {"can_scan", project.can_scan},
      {"scan_complete", project.scan_complete},
      {"stations", json_of_stations(project.stations)},
      {"surface", project.surface ? json_of_surface(*project.surface, project.summary) : Json()}};
  json["exports"] = Json::array();
  for (const ExportEntry& file : project.exports)
    json["exports"].push_back({{"name", file.name}, {"bytes", file.bytes}});
  json["commands"] = Json::object();
  for (const auto& [step, words] : commands)
    json["commands"][step] = words;
  return json;
}

}  // namespace

std::string state_json(const ServiceView& view) {
  Json json{{"version", view.version}};
  json["parts"] = part_names();
  json["projects"] = Json::array();
  for (const ProjectEntry& entry : view.projects) {
    json["projects"].push_back({{"name", entry.name},
                                {"modified_s", entry.modified_s},
                                {"scanned", entry.scanned},
                                {"has_surface", entry.has_surface}});
  }
  json["project"] = view.project ? json_of_project(*view.project, view.commands) : Json();
  json["jobs"] = Json::array();
  for (const Job& job : view.jobs)
    json["jobs"].push_back(json_of_job(job));
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace frangia
