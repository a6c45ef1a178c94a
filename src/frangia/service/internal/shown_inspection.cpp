#include "frangia/service/internal/shown_inspection.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"
#include "frangia/inspection/verdict_reasons.h"
#include "frangia/inspection/write_inspection_plan.h"
#include "frangia/report/inspection_json.h"
#include "frangia/service/internal/project_names.h"

namespace frangia {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostWarnings = 50;  // a plan of another part has one for each feature

Json finite_or_null(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

/// How far a pose turns and moves the surface, and how it fits then.
Json json_of_pose(const AlignmentPose& pose) {
  const Eigen::Isometry3d& motion = pose.reference_from_mesh;
  return {{"turned_deg", deg_from_rad(Eigen::AngleAxisd(motion.linear()).angle())},
          {"moved_mm", motion.translation().norm()},
          {"overlap", pose.overlap},
          {"rms_mm", finite_or_null(pose.rms_mm)}};
}

Json json_of_vector(const Eigen::Vector3d& v) {
  return {finite_or_null(v.x()), finite_or_null(v.y()), finite_or_null(v.z())};
}

Json json_of_row(const MeasuredCharacteristic& row) {
  Json limits;
  if (row.limits) limits = {finite_or_null(row.limits->lower), finite_or_null(row.limits->upper)};
  return {{"name", row.name},
          {"kind", row.kind ? Json(name_of(*row.kind)) : Json("diameter")},
          {"feature", row.feature},
          {"datum", row.datum},
          {"unit", row.unit},
          {"nominal", row.nominal ? Json(*row.nominal) : Json()},
          {"limits", limits},
          {"value", finite_or_null(row.value)},
          {"u95", finite_or_null(row.u95)},
          {"used", row.limits ? finite_or_null(tolerance_used(row)) : Json()},
          {"verdict", row.limits ? Json(name_of(row.conformity)) : Json()}};
}

/// The name that the plan gives a feature; null for one that it does not name.
Json name_in_plan(const Inspection& found, const Shape& shape) {
  for (const NamedFeature& named : found.named_features) {
    if (named.shape.kind == shape.kind && named.shape.center_mm == shape.center_mm)
      return named.name;
  }
  return {};
}

Json json_of_feature(const Inspection& found,
                     std::size_t index,
                     const Eigen::Isometry3d& surface_from_reference) {
  const Feature& feature = found.features[index];
  const Shape& shape = feature.fit.shape;
  const bool sized = shape.kind != ShapeKind::Plane && shape.kind != ShapeKind::Line;
  const bool has_face = index < found.nominals.size() && found.nominals[index];
  const double nominal_mm =
      has_face && sized ? 2.0 * found.nominals[index]->shape.radius_mm : kMissing;
  return {{"name", name_in_plan(found, shape)},
          {"kind", name_of(shape.kind)},
          {"hole", feature.hole},
          {"diameter_mm", sized ? finite_or_null(2.0 * shape.radius_mm) : Json()},
          {"u95_mm", finite_or_null(feature.uncertainty.u95_mm)},
          {"form_mm", is_surface(shape.kind) ? finite_or_null(feature.fit.form_mm) : Json()},
          {"near_mm", json_of_vector(shape.center_mm)},
          {"at_mm", json_of_vector(surface_from_reference * shape.center_mm)},
          {"axis", json_of_vector(surface_from_reference.linear() * shape.axis)},
          {"half_angle_deg",
           shape.kind == ShapeKind::Cone ? Json(deg_from_rad(shape.half_angle_rad)) : Json()},
          {"face", has_face ? Json(found.nominals[index]->number) : Json()},
          {"nominal_mm", finite_or_null(nominal_mm)}};
}

}  // namespace

InspectionPlan usual_plan() {
  InspectionPlan plan;
  plan.align = "best-fit";
  plan.tolerance_mm = plan.tolerance();
  return plan;
}

std::string inspection_basis(InspectionPlan plan,
                             const std::string& reference,
                             int reference_number) {
  plan.file.clear();
  plan.part.clear();
  plan.reference.clear();
  plan.report = {};
  return fmt::format("{} {} {}", reference_number, reference, inspection_plan_json(plan, {}));
}

std::shared_ptr<const ShownInspection> shown_inspection(const Mesh& mesh,
                                                        const InspectionRequest& asked,
                                                        int count,
                                                        const Run& run) {
  constexpr std::size_t kHistogramBins = 48;
  constexpr double kScaleOverTolerance = 2.0;
  const InspectionPlan& plan = asked.plan;
  auto shown = std::make_shared<ShownInspection>();
  shown->revision = count;
  shown->asked = asked;
  std::optional<InspectionReference> nominal;
  if (!plan.reference.empty()) {
    run.stage("reference");
    nominal = naming(plan.reference, asked.reference, [&] {
      return read_inspection_reference(plan.reference, {.unit_mm = plan.unit_mm}, run);
    });
  }
  const InspectOptions options{.features = asked.features,
                               .statistics = false,
                               .scan = asked.scan.get(),
                               .mesh_name = "the surface"};
  shown->found = inspect_part(mesh, nominal ? &*nominal : nullptr, plan, options, run);
  const ToleranceLimits limits = plan.tolerance();
  shown->high_mm = kScaleOverTolerance * std::max(std::abs(limits.lower), std::abs(limits.upper));
  shown->low_mm = -shown->high_mm;
  if (shown->found.surface) {
    shown->histogram = deviation_histogram(shown->found.mesh,
                                           shown->found.surface->deviations.deviation_mm,
                                           shown->low_mm,
                                           shown->high_mm,
                                           kHistogramBins);
  }
  shown->found.mesh = {};
  return shown;
}

nlohmann::ordered_json json_of_comparison(const ShownInspection& shown) {
  if (!shown.found.surface) return {};
  const SurfaceInspection& surface = shown.found.surface.value();
  const DeviationSummary& summary = surface.summary;
  const SurfaceVerdict& verdict = surface.verdict;
  const Alignment& alignment = shown.found.alignment.value();
  Json poses = Json::array();
  for (const AlignmentPose& pose : alignment.alternatives)
    poses.push_back(json_of_pose(pose));
  const auto& status = surface.deviations.status;
  const Json pose = json_of_pose(alignment.pose);
  return {{"revision", shown.revision},
          {"reference", shown.asked.reference},
          {"reference_triangles", shown.found.reference->triangles},
          {"best_fit", shown.asked.plan.align == "best-fit"},
          {"start", std::max<std::size_t>(shown.asked.plan.start, 1)},
          {"poses", poses},
          {"tolerance_mm", {verdict.rule.limits.lower, verdict.rule.limits.upper}},
          {"scale_mm", {shown.low_mm, shown.high_mm}},
          {"histogram", shown.histogram},
          {"verdict", std::string(name_of(verdict.conformity))},
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
          {"overlap", pose.at("overlap")},
          {"fit_rms_mm", pose.at("rms_mm")},
          {"turned_deg", pose.at("turned_deg")},
          {"moved_mm", pose.at("moved_mm")},
          {"left_out",
           static_cast<std::size_t>(std::count_if(
               status.begin(),
               status.end(),
               [](DeviationStatus one) { return one != DeviationStatus::Compared; }))},
          {"free_directions", alignment.free_directions}};
}

nlohmann::ordered_json json_of_inspection(const ShownInspection& shown) {
  const Inspection& found = shown.found;
  Eigen::Isometry3d surface_from_reference = Eigen::Isometry3d::Identity();
  if (found.alignment) surface_from_reference = found.alignment->pose.reference_from_mesh.inverse();
  Json rows = Json::array();
  for (const MeasuredCharacteristic& row : found.characteristics)
    rows.push_back(json_of_row(row));
  Json features = Json::array();
  for (std::size_t i = 0; i < found.features.size(); ++i)
    features.push_back(json_of_feature(found, i, surface_from_reference));
  Json places = Json::array();
  if (found.surface) {
    for (const SurfacePlace& place : found.surface->verdict.places) {
      places.push_back({{"decision", name_of(place.decision)},
                        {"at_mm", json_of_vector(surface_from_reference * place.at_mm)},
                        {"near_mm", json_of_vector(place.at_mm)},
                        {"normal", json_of_vector(surface_from_reference.linear() * place.normal)},
                        {"deviation_mm", finite_or_null(place.deviation_mm)},
                        {"u95_mm", finite_or_null(place.u95_mm)},
                        {"area_mm2", place.area_mm2},
                        {"missing", place.missing}});
    }
  }
  Json warnings = Json::array();
  for (std::size_t i = 0; i < std::min(kMostWarnings, found.warnings.size()); ++i)
    warnings.push_back(found.warnings[i]);
  const auto& walls = found.walls;
  return {{"revision", shown.revision},
          {"verdict", name_of(found.verdict)},
          {"reasons", Json::parse(reasons_json(found.reasons))},
          {"warnings", warnings},
          {"searched", found.searched},
          {"characteristics", rows},
          {"features", features},
          {"places", places},
          {"thickness_mm",
           walls ? Json{finite_or_null(walls->summary.min_mm),
                        finite_or_null(walls->summary.median_mm),
                        finite_or_null(walls->summary.max_mm)}
                 : Json()}};
}

}  // namespace frangia
