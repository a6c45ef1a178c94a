#include "inspect_comparison.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/lowercase_extension.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/files/deviation_csv.h"
#include "frangia/files/ply.h"
#include "frangia/files/write_mesh.h"
#include "frangia/frames/map_picture.h"
#include "frangia/inspect/surface_completeness.h"
#include "frangia/inspect/surface_error.h"
#include "frangia/inspect/surface_validity.h"

#include "check_can_write.h"
#include "fixed_text.h"
#include "inspect_report.h"
#include "json_number.h"

namespace frangia {
namespace {

using Json = nlohmann::ordered_json;

SurfaceCompleteness completeness_of(const InspectArguments& arguments,
                                    const RayScene& reference,
                                    const RayScene& mesh,
                                    const Run& run) {
  const CompletenessOptions options{.within_mm = arguments.within_mm,
                                    .max_angle_rad = rad_from_deg(arguments.max_angle_deg)};
  if (arguments.scan.empty()) return surface_completeness(reference, mesh, options, run);
  const Scan scan = read_scan(arguments.scan, run);
  std::vector<Eigen::Isometry3d> poses;
  for (const ScanView& view : scan.views)
    poses.push_back(scan.rig.rig_from_object(view.angle_rad));
  return surface_completeness(reference, mesh, MeasurementViews{scan.rig, poses}, options, run);
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

std::string left_out_text(const DeviationSummary& summary) {
  std::vector<std::string> parts;
  for (std::size_t i = 1; i < kDeviationStatuses; ++i) {
    std::string name(name_of(static_cast<DeviationStatus>(i)));
    std::replace(name.begin(), name.end(), '_', ' ');
    if (summary.count.at(i) > 0) parts.push_back(fmt::format("{} {}", summary.count.at(i), name));
  }
  return parts.empty() ? "none" : fmt::format("{}", fmt::join(parts, ", "));
}

std::vector<VertexProperty> measured_properties(const InspectedPart& part) {
  std::vector<VertexProperty> more;
  const auto add = [&](const char* name, const std::vector<float>& values) {
    if (!values.empty()) more.push_back({name, values});
  };
  if (part.comparison) {
    add("deviation_mm", part.comparison->deviations.deviation_mm);
    add("u_mm", part.comparison->deviations.u_mm);
  }
  if (part.walls) {
    add("thickness_mm", part.walls->thickness.thickness_mm);
    add("thickness_u_mm", part.walls->thickness.u_mm);
  }
  return more;
}

}  // namespace

SurfaceInspection compare_with(const InspectArguments& arguments,
                               const Mesh& mesh,
                               const Reference& reference,
                               const std::optional<Alignment>& alignment,
                               const Run& run) {
  constexpr double kPerMillion = 1e-6;
  DeviationOptions options;
  if (alignment) options.pose = alignment->pose.uncertainty;
  options.expansion_per_k = kPerMillion * arguments.expansion_ppm_per_k;
  options.temperature_u_k = arguments.temperature_u_k;
  options.exact = reference.cad.get();
  SurfaceRule rule = arguments.surface;
  rule.limits = arguments.alignment.band();
  SurfaceInspection found = inspect_surface(mesh, reference.scene, rule, options, run);
  if (!(found.summary.area_mm2 > 0.0)) {
    throw Error(ErrorKind::Numeric,
                fmt::format("no part of the mesh can be compared with the reference; vertices left "
                            "out: {}; `align` best-fit finds the pose, and `units` states the unit "
                            "of the reference",
                            left_out_text(found.summary)));
  }
  return found;
}

void add_deviations(InspectAnswer& answer, const SurfaceInspection& comparison) {
  const DeviationSummary& summary = comparison.summary;
  const SurfaceVerdict& verdict = comparison.verdict;
  const ToleranceLimits& limits = verdict.rule.limits;
  answer.verdict = verdict.conformity;
  Json& json = answer.json["deviation"];
  json = json_of_verdict(verdict);
  json.update(Json{{"rms_mm", number_or_null(summary.rms_mm)},
                   {"mean_mm", number_or_null(summary.mean_mm)},
                   {"min_mm", number_or_null(summary.min_mm)},
                   {"max_mm", number_or_null(summary.max_mm)},
                   {"min_at_mm", json_of_place(summary.min_at_mm)},
                   {"max_at_mm", json_of_place(summary.max_at_mm)},
                   {"area_mm2", summary.area_mm2},
                   {"median_u_mm", number_or_null(summary.median_u_mm)},
                   {"largest_alignment_u_mm", comparison.deviations.largest_pose_u_mm},
                   {"largest_temperature_u_mm", comparison.deviations.largest_temperature_u_mm},
                   {"vertices", json_of_counts(summary)}});
  answer.text += fmt::format("tolerance {} to {} mm: {}\n",
                             signed_text(limits.lower, 4),
                             signed_text(limits.upper, 4),
                             sentence_of(verdict));
  if (comparison.deviations.u_mm.empty()) {
    answer.text +=
        "the mesh has no sigma: its uncertainty is not known, and the limits alone decide\n";
  }
  const bool has_means = std::isfinite(verdict.lowest.deviation_mm);
  answer.text +=
      fmt::format("means over patches of {:.3g} mm: {}; single vertices: {} at {} to {} at {}\n",
                  verdict.rule.min_feature_mm,
                  has_means ? fmt::format("{} to {} mm",
                                          signed_text(verdict.lowest.deviation_mm, 4),
                                          signed_text(verdict.highest.deviation_mm, 4))
                            : "none was measured well enough to be judged",
                  signed_text(summary.min_mm, 4),
                  place_text(summary.min_at_mm),
                  signed_text(summary.max_mm, 4),
                  place_text(summary.max_at_mm));
  answer.text += fmt::format("vertices left out: {}\n", left_out_text(summary));
}

void add_statistics(InspectAnswer& answer,
                    const InspectArguments& arguments,
                    const Mesh& mesh,
                    const Reference& reference,
                    const Run& run) {
  run.stage("statistics");
  const RayScene mesh_scene(mesh, run);
  const SurfaceError error =
      surface_error(mesh, reference.scene, {.exact = reference.cad.get()}, run);
  const SurfaceCompleteness completeness =
      completeness_of(arguments, reference.scene, mesh_scene, run);
  const SurfaceValidity validity =
      surface_validity(mesh, reference.scene, run, reference.cad.get());
  answer.json.update(Json{{"vertices", error.count},
                          {"rms_mm", error.rms_mm},
                          {"mean_mm", error.mean_mm},
                          {"bias_mm", error.bias_mm},
                          {"p95_mm", error.p95_mm},
                          {"p99_mm", error.p99_mm},
                          {"max_mm", error.max_mm},
                          {"sigma_ratio", number_or_null(validity.sigma_ratio)},
                          {"non_manifold_edges", validity.non_manifold_edges},
                          {"inward_triangles", validity.inward_triangles},
                          {"completeness", completeness.share},
                          {"completeness_within_mm", arguments.within_mm}});
  answer.text += fmt::format(
      "{} vertices: RMS {:.4f} mm, bias {}, 95 % within {:.4f}, 99 % within {:.4f}, all "
      "within {:.4f}\n",
      error.count,
      error.rms_mm,
      signed_text(error.bias_mm, 4),
      error.p95_mm,
      error.p99_mm,
      error.max_mm);
  answer.text += fmt::format(
      "{:.1f} % of the {} has mesh within {} mm\n",
      100.0 * completeness.share,
      arguments.scan.empty() ? "reference" : "reference that the scan's views could measure",
      arguments.within_mm);
}

double scale_mm(const InspectArguments& arguments, const ToleranceLimits& limits) {
  constexpr double kBeyond = 1.5;
  if (arguments.scale_mm > 0.0) return arguments.scale_mm;
  return kBeyond * std::max(std::abs(limits.lower), std::abs(limits.upper));
}

void check_deviation_output(const std::filesystem::path& path) {
  if (lowercase_extension(path) != ".csv") check_mesh_extension(path);
  check_can_write(path);
}

void write_deviations(const std::filesystem::path& path,
                      const InspectArguments& arguments,
                      const InspectedPart& part,
                      const Run& run) {
  const Mesh& mesh = part.mesh;
  const std::string extension = lowercase_extension(path);
  if (extension == ".ply") {
    write_ply(path, mesh, measured_properties(part));
    return;
  }
  const SurfaceInspection& comparison = part.comparison.value();
  const Deviations& found = comparison.deviations;
  if (extension == ".csv") {
    const auto decided = conformities(found, comparison.verdict.rule.limits);
    std::vector<DeviationRow> rows;
    for (std::size_t i = 0; i < decided.size(); ++i) {
      if (found.status[i] != DeviationStatus::Compared) continue;
      rows.push_back({static_cast<std::uint32_t>(i),
                      mesh.vertices_mm[i],
                      found.deviation_mm[i],
                      found.u_mm.empty() ? kMissing : found.u_mm[i],
                      name_of(decided[i])});
    }
    write_deviation_csv(path, rows);
    return;
  }
  Mesh colored = mesh;
  colored.colors.clear();
  const double scale = scale_mm(arguments, comparison.verdict.rule.limits);
  for (const float deviation : found.deviation_mm) {
    const float share = 0.5F + 0.5F * deviation / static_cast<float>(scale);
    colored.colors.push_back(pixel_of(ColorMap::Diverging, share));
  }
  write_mesh(path, colored, {}, run);
}

}  // namespace frangia
