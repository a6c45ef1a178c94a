#include "frangia/service/internal/surface_json.h"

#include <cmath>

#include "frangia/core/angles.h"

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

Json json_of_comparison(const ShownComparison& shown) {
  const SurfaceComparison& found = shown.found;
  const DeviationSummary& summary = found.summary;
  const SurfaceVerdict& verdict = found.verdict;
  Json poses = Json::array();
  for (const ComparedPose& pose : found.poses) {
    poses.push_back({{"turned_deg", deg_from_rad(pose.turned_rad)},
                     {"moved_mm", pose.moved_mm},
                     {"overlap", pose.overlap},
                     {"rms_mm", finite_or_null(pose.rms_mm)}});
  }
  return {{"revision", shown.revision},
          {"reference", shown.reference},
          {"reference_triangles", found.triangles},
          {"best_fit", shown.best_fit},
          {"start", shown.start + 1},
          {"poses", poses},
          {"tolerance_mm", {verdict.rule.limits.lower, verdict.rule.limits.upper}},
          {"scale_mm", {found.low_mm, found.high_mm}},
          {"histogram", found.histogram},
          {"verdict", std::string(name_of(verdict.conformity))},
          {"sentence", sentence_of(verdict)},
          {"in_share", verdict.share_of(PatchDecision::In)},
          {"out_share", verdict.share_of(PatchDecision::Out)},
          {"undecided_share",
           verdict.share_of(PatchDecision::NearLimit) +
               verdict.share_of(PatchDecision::NotWellMeasured)},
          {"not_measured_share", verdict.share_of(PatchDecision::NotMeasured)},
          {"patch_mm", verdict.rule.min_feature_mm},
          {"rms_mm", finite_or_null(summary.rms_mm)},
          {"mean_mm", finite_or_null(summary.mean_mm)},
          {"min_mm", finite_or_null(summary.min_mm)},
          {"max_mm", finite_or_null(summary.max_mm)},
          {"median_u_mm", finite_or_null(summary.median_u_mm)},
          {"area_mm2", summary.area_mm2},
          {"overlap", found.overlap},
          {"fit_rms_mm", finite_or_null(found.fit_rms_mm)},
          {"turned_deg", deg_from_rad(found.turned_rad)},
          {"moved_mm", found.moved_mm},
          {"left_out", found.left_out},
          {"free_directions", found.free_directions}};
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
  json["comparison"] = surface.comparison ? json_of_comparison(*surface.comparison) : Json();
  json["steps_done"] = surface.done;
  json["fits"] = Json::array();
  for (const SurfaceFit& fit : surface.fits)
    json["fits"].push_back(json_of_fit(fit));
  json["summary"] = summary.empty() ? Json() : Json::parse(summary, nullptr, false);
  if (json["summary"].is_discarded()) json["summary"] = Json();
  return json;
}

}  // namespace frangia
