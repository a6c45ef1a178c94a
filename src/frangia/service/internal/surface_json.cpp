#include "frangia/service/internal/surface_json.h"

#include <cmath>

#include "frangia/service/internal/shown_inspection.h"

namespace frangia {
namespace {

using Json = nlohmann::ordered_json;

Json finite_or_null(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

Json json_of_fit(const SurfaceFit& fit) {
  const auto vector = [](const Eigen::Vector3d& v) { return Json{v.x(), v.y(), v.z()}; };
  return {{"kind", fit.kind},
          {"center_mm", vector(fit.center_mm)},
          {"axis", vector(fit.axis)},
          {"diameter_mm", finite_or_null(fit.diameter_mm)},
          {"u95_mm", finite_or_null(fit.u95_mm)},
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

}  // namespace

nlohmann::ordered_json json_of_surface(const SurfaceSnapshot& surface) {
  const std::string& summary = *surface.summary;
  Json json{{"version", surface.version},
            {"mesh_revision", surface.mesh_revision},
            {"selection_revision", surface.selection_revision},
            {"vertices", surface.vertices},
            {"triangles", surface.triangles},
            {"selected", surface.selected},
            {"components", surface.components},
            {"sigma_mm",
             {{"combined", finite_or_null(surface.sigma.combined_mm)},
              {"noise", finite_or_null(surface.sigma.noise_mm)},
              {"systematic", finite_or_null(surface.sigma.systematic_mm)}}},
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

}  // namespace frangia
