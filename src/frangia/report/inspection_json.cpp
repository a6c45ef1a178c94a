#include "frangia/report/inspection_json.h"

#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "frangia/core/angles.h"

namespace frangia {
namespace {

using Json = nlohmann::ordered_json;

/// A number for JSON; null for one that is missing.
Json number_or_null(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

bool has_diameter(ShapeKind kind) {
  return kind != ShapeKind::Plane && kind != ShapeKind::Line;
}

Json json_of_matrix(const Eigen::Isometry3d& pose) {
  Json rows = Json::array();
  for (Eigen::Index row = 0; row < 4; ++row) {
    const Eigen::Vector4d values = pose.matrix().row(row).transpose();
    rows.push_back({values[0], values[1], values[2], values[3]});
  }
  return rows;
}

Json json_of_pose(const AlignmentPose& pose) {
  return {{"matrix", json_of_matrix(pose.reference_from_mesh)},
          {"rms_mm", pose.rms_mm},
          {"overlap", pose.overlap}};
}

Json json_of_vector(const Eigen::Vector3d& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

Json json_of_feature(const Feature& feature) {
  const Shape& shape = feature.fit.shape;
  const bool fitted = is_surface(shape.kind);
  return {{"kind", name_of(shape.kind)},
          {"diameter_mm", has_diameter(shape.kind) ? Json(2.0 * shape.radius_mm) : Json()},
          {"u95_mm", number_or_null(feature.uncertainty.u95_mm)},
          {"form_mm", fitted ? Json(feature.fit.form_mm) : Json()},
          {"center_mm", json_of_vector(shape.center_mm)},
          {"axis", shape.kind == ShapeKind::Sphere ? Json() : json_of_vector(shape.axis)},
          {"points", feature.fit.points}};
}

Json json_of_details(const Feature& feature) {
  const Shape& shape = feature.fit.shape;
  const ShapeUncertainty& u = feature.uncertainty;
  const double none = std::numeric_limits<double>::quiet_NaN();
  const bool cone = shape.kind == ShapeKind::Cone;
  const bool torus = shape.kind == ShapeKind::Torus;
  return {{"hole", feature.hole},
          {"rms_mm", is_surface(shape.kind) ? Json(feature.fit.rms_mm) : Json()},
          {"half_angle_deg", number_or_null(cone ? deg_from_rad(shape.half_angle_rad) : none)},
          {"half_angle_u95_deg", number_or_null(deg_from_rad(u.angle_u95_rad))},
          {"tube_diameter_mm", number_or_null(torus ? 2.0 * shape.tube_radius_mm : none)},
          {"u_noise_mm", number_or_null(u.noise_mm)},
          {"u_systematic_mm", number_or_null(u.systematic_mm)},
          {"center_u95_mm", number_or_null(u.center_u95_mm)},
          {"axis_u95_deg", number_or_null(deg_from_rad(u.axis_u95_rad))}};
}

Json json_of_nominal(const Feature& feature, const std::optional<NominalFace>& nominal) {
  if (!nominal) return {};
  Json json{{"face", nominal->number},
            {"diameter_mm", Json()},
            {"difference_mm", Json()},
            {"half_angle_deg", Json()},
            {"half_angle_difference_deg", Json()}};
  if (nominal->shape.kind == ShapeKind::Cone) {
    json["half_angle_deg"] = deg_from_rad(nominal->shape.half_angle_rad);
    json["half_angle_difference_deg"] =
        deg_from_rad(feature.fit.shape.half_angle_rad - nominal->shape.half_angle_rad);
  }
  if (has_diameter(nominal->shape.kind)) {
    json["diameter_mm"] = 2.0 * nominal->shape.radius_mm;
    json["difference_mm"] = 2.0 * (feature.fit.shape.radius_mm - nominal->shape.radius_mm);
  }
  return json;
}

Json json_of_counts(const DeviationSummary& summary) {
  Json counts;
  for (std::size_t i = 0; i < kDeviationStatuses; ++i)
    counts[std::string(name_of(static_cast<DeviationStatus>(i)))] = summary.count.at(i);
  return counts;
}

Json json_of_place(const Eigen::Vector3d& at) {
  return {number_or_null(at.x()), number_or_null(at.y()), number_or_null(at.z())};
}

Json json_of_verdict(const SurfaceVerdict& verdict) {
  constexpr std::array<std::string_view, 5> kReasons{
      "none", "not_measured", "noise", "systematic", "near_limit"};
  const SurfaceRule& rule = verdict.rule;
  Json places = Json::array();
  for (const SurfacePlace& place : verdict.places) {
    places.push_back({{"decision", name_of(place.decision)},
                      {"at_mm", json_of_place(place.at_mm)},
                      {"deviation_mm", number_or_null(place.deviation_mm)},
                      {"u95_mm", number_or_null(place.u95_mm)},
                      {"area_mm2", place.area_mm2},
                      {"missing", place.missing}});
  }
  return {{"tolerance_mm", {rule.limits.lower, rule.limits.upper}},
          {"verdict", name_of(verdict.conformity)},
          {"sentence", sentence_of(verdict)},
          {"reason", kReasons.at(static_cast<std::size_t>(verdict.reason))},
          {"in_share", verdict.share_of(PatchDecision::In)},
          {"out_share", verdict.share_of(PatchDecision::Out)},
          {"undecided_share", verdict.share_of(PatchDecision::NearLimit)},
          {"not_well_measured_share", verdict.share_of(PatchDecision::NotWellMeasured)},
          {"not_measured_share", verdict.share_of(PatchDecision::NotMeasured)},
          {"coverage", verdict.coverage},
          {"decidable_mm", number_or_null(verdict.decidable_mm)},
          {"edge_mm", rule.edge_mm.value_or(0.0)},
          {"edge_share", verdict.edge_share},
          {"nominal_area_mm2", verdict.area_mm2},
          {"gap_mm", verdict.gap_mm},
          {"gap_at_mm", json_of_place(verdict.gap_at_mm)},
          {"patch_mm", rule.min_feature_mm},
          {"patches", verdict.patches},
          {"independent_patches", verdict.independent},
          {"max_uncertainty_share", rule.max_uncertainty_share},
          {"min_coverage", rule.min_coverage},
          {"max_gap_mm", rule.max_gap_mm},
          {"filtered_min_mm", number_or_null(verdict.lowest.deviation_mm)},
          {"filtered_max_mm", number_or_null(verdict.highest.deviation_mm)},
          {"places", places}};
}

Json json_of_limits(const std::optional<ToleranceLimits>& limits) {
  if (!limits) return {};
  return {number_or_null(limits->lower), number_or_null(limits->upper)};
}

Json json_of_blade(const BladeSection& blade) {
  return {{"chord_mm", blade.chord_mm},
          {"max_thickness_mm", blade.max_thickness_mm},
          {"leading_radius_mm", blade.leading_radius_mm},
          {"trailing_radius_mm", blade.trailing_radius_mm},
          {"stagger_deg", deg_from_rad(blade.stagger_rad)},
          {"max_camber_mm", blade.max_camber_mm}};
}

/// The measured blade minus the nominal one.
Json json_of_difference(const BladeSection& blade, const BladeSection& nominal) {
  Json difference = json_of_blade(blade);
  const Json from = json_of_blade(nominal);
  for (auto& [key, value] : difference.items())
    value = value.get<double>() - from.at(key).get<double>();
  return difference;
}

void add_alignment(Json& json, const Inspection& part) {
  if (!part.alignment) return;
  const Alignment& alignment = *part.alignment;
  json["alignment"] = json_of_pose(alignment.pose);
  Json poses = Json::array();
  for (const AlignmentPose& pose : alignment.alternatives)
    poses.push_back(json_of_pose(pose));
  json["alignment_details"] = {{"iterations", alignment.pose.iterations},
                               {"free_directions", alignment.free_directions},
                               {"poses", poses}};
  if (!part.points_mm.empty()) json["alignment_details"]["points_mm"] = part.points_mm;
  if (part.datums.empty()) return;
  Json& datums = json["alignment_details"]["datums"];
  datums = Json::array();
  for (const DatumResidual& one : part.datums) {
    datums.push_back({{"name", one.name},
                      {"angle_deg", deg_from_rad(one.angle_rad)},
                      {"distance_mm", one.distance_mm}});
  }
}

void add_features(Json& json, const Inspection& part) {
  if (!part.searched) return;
  json["features"] = Json::array();
  json["feature_details"] = Json::array();
  for (std::size_t i = 0; i < part.features.size(); ++i) {
    json["features"].push_back(json_of_feature(part.features[i]));
    Json details = json_of_details(part.features[i]);
    if (!part.nominals.empty())
      details["nominal"] = json_of_nominal(part.features[i], part.nominals[i]);
    json["feature_details"].push_back(details);
  }
}

void add_statistics(Json& json, const SurfaceStatistics& statistics) {
  const SurfaceError& error = statistics.error;
  json.update(Json{{"vertices", error.count},
                   {"rms_mm", error.rms_mm},
                   {"mean_mm", error.mean_mm},
                   {"bias_mm", error.bias_mm},
                   {"p95_mm", error.p95_mm},
                   {"p99_mm", error.p99_mm},
                   {"max_mm", error.max_mm},
                   {"sigma_ratio", number_or_null(statistics.validity.sigma_ratio)},
                   {"non_manifold_edges", statistics.validity.non_manifold_edges},
                   {"inward_triangles", statistics.validity.inward_triangles},
                   {"completeness", statistics.completeness.share},
                   {"completeness_within_mm", statistics.within_mm}});
}

Json json_of_surface(const SurfaceInspection& surface, bool tolerance_is_default) {
  const DeviationSummary& summary = surface.summary;
  Json json = json_of_verdict(surface.verdict);
  json.update(Json{{"rms_mm", number_or_null(summary.rms_mm)},
                   {"mean_mm", number_or_null(summary.mean_mm)},
                   {"min_mm", number_or_null(summary.min_mm)},
                   {"max_mm", number_or_null(summary.max_mm)},
                   {"min_at_mm", json_of_place(summary.min_at_mm)},
                   {"max_at_mm", json_of_place(summary.max_at_mm)},
                   {"area_mm2", summary.area_mm2},
                   {"median_u_mm", number_or_null(summary.median_u_mm)},
                   {"largest_alignment_u_mm", surface.deviations.largest_pose_u_mm},
                   {"largest_temperature_u_mm", surface.deviations.largest_temperature_u_mm},
                   {"vertices", json_of_counts(summary)}});
  json["tolerance_is_default"] = tolerance_is_default;
  return json;
}

Json json_of_walls(const ThicknessSummary& summary) {
  Json counts;
  for (std::size_t i = 0; i < kThicknessStatuses; ++i)
    counts[std::string(name_of(static_cast<ThicknessStatus>(i)))] = summary.count.at(i);
  const Eigen::Vector3d& at = summary.min_at_mm;
  return {{"area_mm2", summary.area_mm2},
          {"mean_mm", number_or_null(summary.mean_mm)},
          {"p5_mm", number_or_null(summary.p5_mm)},
          {"median_mm", number_or_null(summary.median_mm)},
          {"p95_mm", number_or_null(summary.p95_mm)},
          {"min_mm", number_or_null(summary.min_mm)},
          {"min_u_mm", number_or_null(summary.min_u_mm)},
          {"min_at_mm", {number_or_null(at.x()), number_or_null(at.y()), number_or_null(at.z())}},
          {"max_mm", number_or_null(summary.max_mm)},
          {"median_u_mm", number_or_null(summary.median_u_mm)},
          {"vertices", counts}};
}

Json json_of_characteristics(const std::vector<MeasuredCharacteristic>& characteristics) {
  Json rows = Json::array();
  for (const MeasuredCharacteristic& row : characteristics) {
    rows.push_back({{"name", row.name},
                    {"unit", row.unit},
                    {"nominal", row.nominal ? Json(*row.nominal) : Json()},
                    {"limits", json_of_limits(row.limits)},
                    {"value", number_or_null(row.value)},
                    {"u95", number_or_null(row.u95)},
                    {"conformity", row.limits ? Json(name_of(row.conformity)) : Json()},
                    {"reason", row.reason.empty() ? Json() : Json(row.reason)}});
  }
  return rows;
}

Json json_of_sections(const std::vector<SectionResult>& cut) {
  Json sections = Json::array();
  for (const SectionResult& section : cut) {
    Json one{{"name", section.name},
             {"curves", section.measured.size()},
             {"length_mm", section.measured.empty() ? 0.0 : length_mm(section.measured.front())}};
    if (section.blade) one["blade"] = json_of_blade(*section.blade);
    if (section.nominal_blade) one["nominal_blade"] = json_of_blade(*section.nominal_blade);
    if (section.blade && section.nominal_blade)
      one["blade_difference"] = json_of_difference(*section.blade, *section.nominal_blade);
    sections.push_back(one);
  }
  return sections;
}

Json json_of_clause(const VerdictClause& clause) {
  Json values = Json::object();
  for (const auto& [name, value] : clause.values) {
    Json& json = values[std::string(name)];
    if (const auto* number = std::get_if<double>(&value)) json = number_or_null(*number);
    if (const auto* place = std::get_if<Eigen::Vector3d>(&value)) json = json_of_place(*place);
    if (const auto* text = std::get_if<std::string>(&value)) json = *text;
  }
  return {{"id", clause.id}, {"values", values}, {"text", clause.text}};
}

Json json_of_reasons(const std::vector<VerdictReason>& reasons) {
  Json json = Json::array();
  for (const VerdictReason& reason : reasons) {
    Json clauses = Json::array();
    for (const VerdictClause& clause : reason.clauses)
      clauses.push_back(json_of_clause(clause));
    json.push_back({{"about", reason.about}, {"sentence", reason.text()}, {"clauses", clauses}});
  }
  return json;
}

}  // namespace

std::string reasons_json(const std::vector<VerdictReason>& reasons) {
  return json_of_reasons(reasons).dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string inspection_json(const Inspection& part) {
  Json json = Json::object();
  if (part.reference && part.reference->is_cad)
    json["reference"] = {{"faces", part.reference->faces}, {"unit", part.reference->unit}};
  add_alignment(json, part);
  add_features(json, part);
  if (part.statistics) add_statistics(json, *part.statistics);
  if (part.surface) json["deviation"] = json_of_surface(*part.surface, part.tolerance_is_default);
  if (part.walls) json["thickness"] = json_of_walls(part.walls->summary);
  if (!part.characteristics.empty())
    json["characteristics"] = json_of_characteristics(part.characteristics);
  if (!part.reasons.empty()) {
    json["verdict"] = name_of(part.verdict);
    json["reasons"] = json_of_reasons(part.reasons);
  }
  if (!part.sections.empty()) json["sections"] = json_of_sections(part.sections);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace frangia
