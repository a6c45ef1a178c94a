#include "inspect_report.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <utility>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/angles.h"
#include "frangia/core/median.h"
#include "frangia/core/sha256.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/uncertainty/uncertainty_budget.h"

#include "inspect_report_pictures.h"
#include "json_number.h"
#include "text_table.h"

namespace frangia {
namespace {

using Json = nlohmann::ordered_json;
using NamedTexts = std::vector<std::pair<std::string, std::string>>;

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

std::optional<BladeSection> blade_of(const std::vector<SectionCurve>& curves,
                                     const std::string& name,
                                     const Run& run) {
  if (curves.empty()) return std::nullopt;
  try {
    return measure_blade_section(curves.front());
  } catch (const Error& error) {
    run.warn(fmt::format("{}: {}", name, error.what()));
    return std::nullopt;
  }
}

double median_of_finite(const std::vector<float>& values) {
  std::vector<float> known;
  std::copy_if(values.begin(), values.end(), std::back_inserter(known), [](float value) {
    return std::isfinite(value);
  });
  return known.empty() ? static_cast<double>(kMissing)
                       : static_cast<double>(median(std::move(known)));
}

/// The terms of a part of a vertex's uncertainty, in words. That of the temperature stands apart.
std::string names_of(UncertaintyPart part) {
  std::string names;
  for (const UncertaintyTermInfo& info : uncertainty_terms()) {
    if (info.part != part || info.term == UncertaintyTerm::Temperature) continue;
    names += (names.empty() ? "" : ", ") + std::string(info.name);
  }
  std::replace(names.begin(), names.end(), '_', ' ');
  return names;
}

std::vector<std::pair<std::string, double>> uncertainty_terms_of(const InspectedPart& part) {
  std::vector<std::pair<std::string, double>> terms;
  const auto add = [&](const std::string& name, double value) {
    if (std::isfinite(value)) terms.emplace_back(name, value);
  };
  const Mesh& mesh = part.mesh;
  if (mesh.sigma_mm.empty()) return terms;
  add("noise of a vertex, median (" + names_of(UncertaintyPart::Noise) + ")",
      median_of_finite(mesh.sigma_noise_mm.empty() ? mesh.sigma_mm : mesh.sigma_noise_mm));
  if (!mesh.sigma_systematic_mm.empty()) {
    add("systematic part of a vertex, median (" + names_of(UncertaintyPart::Systematic) + ")",
        median_of_finite(mesh.sigma_systematic_mm));
  }
  if (part.comparison) {
    if (part.alignment)
      add("pose on the reference, largest", part.comparison->deviations.largest_pose_u_mm);
    add("temperature, largest", part.comparison->deviations.largest_temperature_u_mm);
    add("deviation, combined, median", part.comparison->summary.median_u_mm);
  }
  return terms;
}

NamedTexts conditions_of(const InspectArguments& arguments, const Run& run) {
  NamedTexts conditions{{"SHA-256 of the mesh", sha256_of_file(arguments.mesh)}};
  if (!arguments.reference.empty()) {
    conditions.emplace_back("reference", arguments.reference.filename().string());
    conditions.emplace_back("SHA-256 of the reference", sha256_of_file(arguments.reference));
  }
  if (!arguments.plan.empty()) {
    conditions.emplace_back("plan", arguments.plan.filename().string());
    conditions.emplace_back("SHA-256 of the plan", sha256_of_file(arguments.plan));
  }
  if (arguments.temperature_u_k > 0.0) {
    conditions.emplace_back("thermal expansion",
                            fmt::format("{:g} 1e-6/K, temperature uncertain by {:g} K",
                                        arguments.expansion_ppm_per_k,
                                        arguments.temperature_u_k));
  }
  if (arguments.scan.empty()) {
    conditions.emplace_back("rig and calibration", "not stated; --scan names the scan of the mesh");
    return conditions;
  }
  const Scan scan = read_scan(arguments.scan, run);
  conditions.emplace_back("scan", arguments.scan.filename().string());
  const auto& calibration = scan.rig.calibration;
  conditions.emplace_back("calibrated", calibration ? calibration->date : "date not known");
  if (calibration) {
    conditions.emplace_back(
        "uncertainty of a point by the calibration",
        fmt::format(
            "{:.4f} mm at {:.0f} mm", calibration->point_sigma_mm, calibration->distance_mm));
  }
  for (const char* name : {"scan.toml", "rig.toml"}) {
    const auto path = arguments.scan / name;
    if (std::filesystem::exists(path))
      conditions.emplace_back(fmt::format("SHA-256 of {}", name), sha256_of_file(path));
  }
  return conditions;
}

NamedTexts alignment_rows(const InspectedPart& part) {
  if (!part.alignment) return {};
  const AlignmentPose& pose = part.alignment->pose;
  NamedTexts rows{{"overlap", fmt::format("{:.2f} %", 100.0 * pose.overlap)},
                  {"RMS, mm", fmt::format("{:.4f}", pose.rms_mm)},
                  {"iterations", fmt::format("{}", pose.iterations)}};
  const auto& matrix = pose.reference_from_mesh.matrix();
  for (Eigen::Index row = 0; row < 4; ++row) {
    rows.emplace_back(row == 0 ? "reference from mesh" : "",
                      fmt::format("{:.6f}  {:.6f}  {:.6f}  {:.6f}",
                                  matrix(row, 0),
                                  matrix(row, 1),
                                  matrix(row, 2),
                                  matrix(row, 3)));
  }
  for (const std::string& direction : part.alignment->free_directions)
    rows.emplace_back("not determined by the shape", direction);
  return rows;
}

std::string file_name_part(const std::string& name) {
  std::string safe;
  for (const char c : name)
    safe += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.' ? c : '-';
  return safe;
}

std::string created_now() {
  return fmt::format(
      "{:%Y-%m-%d %H:%M:%S} UTC",
      fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())));
}

}  // namespace

std::vector<SectionResult> cut_sections(const InspectionPlan& plan,
                                        const Mesh& mesh,
                                        const RayScene* reference,
                                        const std::optional<SurfaceInspection>& comparison,
                                        const Run& run) {
  std::vector<SectionResult> sections;
  for (const PlannedSection& planned : plan.sections) {
    SectionResult section;
    section.name = planned.name;
    section.plane = section_plane(planned.point_mm, planned.normal);
    const std::vector<float> values =
        comparison ? comparison->deviations.deviation_mm : std::vector<float>{};
    section.measured = section_curves(mesh, section.plane, values);
    if (reference != nullptr) section.reference = section_curves(reference->mesh(), section.plane);
    if (planned.blade) {
      section.blade = blade_of(section.measured, planned.name, run);
      section.nominal_blade = blade_of(section.reference, planned.name + ", nominal", run);
    }
    sections.push_back(std::move(section));
  }
  return sections;
}

void add_results(InspectAnswer& answer, const InspectedPart& part) {
  if (!part.characteristics.empty()) {
    Json rows = Json::array();
    TextColumn name{"characteristic", {}, false};
    TextColumn value{"measured", {}};
    TextColumn u95{"U95", {}};
    TextColumn decision{"decision", {}, false};
    for (const MeasuredCharacteristic& row : part.characteristics) {
      rows.push_back({{"name", row.name},
                      {"unit", row.unit},
                      {"nominal", row.nominal ? Json(*row.nominal) : Json()},
                      {"limits", json_of_limits(row.limits)},
                      {"value", number_or_null(row.value)},
                      {"u95", number_or_null(row.u95)},
                      {"conformity", row.limits ? Json(name_of(row.conformity)) : Json()}});
      name.values.push_back(row.name);
      value.values.push_back(std::isfinite(row.value) ? fmt::format("{:.4f}", row.value)
                                                      : "not found");
      u95.values.push_back(std::isfinite(row.u95) ? fmt::format("{:.4f}", row.u95) : "");
      decision.values.emplace_back(row.limits ? name_of(row.conformity) : "");
    }
    answer.json["characteristics"] = rows;
    answer.text += text_table({name, value, u95, decision});
    const Conformity rows_verdict = overall(part.characteristics);
    if (rows_verdict == Conformity::Out) answer.verdict = Conformity::Out;
  }
  if (part.sections.empty()) return;
  Json sections = Json::array();
  for (const SectionResult& section : part.sections) {
    Json one{{"name", section.name},
             {"curves", section.measured.size()},
             {"length_mm", section.measured.empty() ? 0.0 : length_mm(section.measured.front())}};
    if (section.blade) one["blade"] = json_of_blade(*section.blade);
    if (section.nominal_blade) one["nominal_blade"] = json_of_blade(*section.nominal_blade);
    if (section.blade && section.nominal_blade)
      one["blade_difference"] = json_of_difference(*section.blade, *section.nominal_blade);
    sections.push_back(one);
    answer.text += fmt::format("section {}: {} curve{}\n",
                               section.name,
                               section.measured.size(),
                               section.measured.size() == 1 ? "" : "s");
    if (!section.blade) continue;
    answer.text += fmt::format(
        "  chord {:.3f} mm, largest thickness {:.3f} mm, leading radius {:.3f} mm, trailing "
        "radius {:.3f} mm, stagger {:.3f} degrees\n",
        section.blade->chord_mm,
        section.blade->max_thickness_mm,
        section.blade->leading_radius_mm,
        section.blade->trailing_radius_mm,
        deg_from_rad(section.blade->stagger_rad));
  }
  answer.json["sections"] = sections;
}

std::vector<std::string> write_report(const InspectArguments& arguments,
                                      const InspectionPlan& plan,
                                      const InspectedPart& part,
                                      const InspectAnswer& answer,
                                      const std::vector<std::string>& warnings,
                                      const Run& run) {
  run.stage("report");
  InspectionReport report;
  report.part = plan.part;
  report.fields = plan.report;
  if (!plan.report.logo.empty()) report.logo = read_logo(plan.report.logo);
  report.mesh = arguments.mesh.filename().string();
  report.created = created_now();
  report.version = "Frangia " FRANGIA_VERSION;
  report.conditions = conditions_of(arguments, run);
  report.alignment = alignment_rows(part);
  if (part.comparison) {
    report.deviation = part.comparison->summary;
    report.surface = part.comparison->verdict;
  }
  if (part.walls) report.thickness = part.walls->summary;
  report.pictures = report_pictures(arguments, part, run);
  report.characteristics = part.characteristics;
  report.features = part.features;
  report.nominals = part.nominals;
  report.sections = part.sections;
  report.uncertainty_mm = uncertainty_terms_of(part);
  report.systematic_known = !part.mesh.sigma_systematic_mm.empty();
  report.correlation_known = part.knows_calibration;
  report.warnings = warnings;

  std::vector<std::string> written;
  const auto write = [&](const std::filesystem::path& path, const std::string& text) {
    write_report_text(path, text);
    written.push_back(path.string());
  };
  const auto beside = [&](const std::string& ending) {
    std::filesystem::path path = arguments.report;
    return path.replace_extension(ending);
  };
  for (const SectionResult& section : part.sections) {
    if (section.measured.empty()) continue;
    const std::string stem = arguments.report.stem().string() + "-" + file_name_part(section.name);
    write(arguments.report.parent_path() / (stem + ".svg"), svg_of(section));
    write(arguments.report.parent_path() / (stem + ".dxf"), dxf_of(section));
  }
  if (!part.characteristics.empty()) write(beside(".csv"), csv_of(part.characteristics));
  Json json = answer.json;
  json["verdict"] = name_of(verdict_of(report));
  json["created"] = report.created;
  json["version"] = report.version;
  write(beside(".json"), json.dump(2, ' ', true, nlohmann::json::error_handler_t::replace) + "\n");
  write(arguments.report, html_of(report));
  return written;
}

}  // namespace frangia
