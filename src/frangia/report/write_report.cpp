#include "frangia/report/write_report.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <ctime>
#include <set>
#include <utility>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/checksums.h"
#include "frangia/core/durable_file.h"
#include "frangia/core/statistics.h"
#include "frangia/report/inspection_json.h"
#include "frangia/report/report_pictures.h"
#include "frangia/report/section_drawing.h"
#include "frangia/uncertainty/uncertainty_budget.h"

namespace frangia {
namespace {

using NamedTexts = std::vector<std::pair<std::string, std::string>>;

/// Median over the vertices that were compared with the reference, of which the combined
/// uncertainty is, too; over all without a reference.
double median_of_finite(const std::vector<float>& values, const Inspection& part) {
  std::vector<float> known;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool counts =
        !part.surface || part.surface->deviations.status[i] == DeviationStatus::Compared;
    if (counts && std::isfinite(values[i])) known.push_back(values[i]);
  }
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

std::vector<std::pair<std::string, double>> uncertainty_terms_of(const Inspection& part) {
  std::vector<std::pair<std::string, double>> terms;
  const auto add = [&](const std::string& name, double value) {
    if (std::isfinite(value)) terms.emplace_back(name, value);
  };
  const Mesh& mesh = part.mesh;
  if (mesh.sigma_mm.empty()) return terms;
  add("noise of a vertex, median (" + names_of(UncertaintyPart::Noise) + ")",
      median_of_finite(mesh.sigma_noise_mm.empty() ? mesh.sigma_mm : mesh.sigma_noise_mm, part));
  if (!mesh.sigma_systematic_mm.empty()) {
    add("systematic part of a vertex, median (" + names_of(UncertaintyPart::Systematic) + ")",
        median_of_finite(mesh.sigma_systematic_mm, part));
  }
  if (part.surface) {
    if (part.alignment)
      add("pose on the reference, largest", part.surface->deviations.largest_pose_u_mm);
    if (part.surface->deviations.largest_temperature_u_mm > 0.0)
      add("temperature, largest", part.surface->deviations.largest_temperature_u_mm);
    add("deviation, combined, median", part.surface->summary.median_u_mm);
  }
  return terms;
}

/// For people; empty without a reference.
std::string reference_name(const ReportSources& sources) {
  return sources.reference_name.empty() ? sources.reference.filename().string()
                                        : sources.reference_name;
}

NamedTexts conditions_of(const InspectionPlan& plan, const ReportSources& sources) {
  const ReportWords words(plan.report.language);
  NamedTexts conditions;
  if (!sources.mesh.empty())
    conditions.emplace_back("SHA-256 of the mesh", sha256_of_file(sources.mesh));
  if (!sources.reference.empty()) {
    conditions.emplace_back("reference", reference_name(sources));
    conditions.emplace_back("SHA-256 of the reference", sha256_of_file(sources.reference));
  }
  if (!plan.file.empty()) {
    conditions.emplace_back("plan", plan.file.filename().string());
    conditions.emplace_back("SHA-256 of the plan", sha256_of_file(plan.file));
  }
  if (plan.temperature_u_k > 0.0) {
    conditions.emplace_back("thermal expansion",
                            words(fmt::format("{:g} 1e-6/K, temperature uncertain by {:g} K",
                                              plan.expansion_ppm_per_k,
                                              plan.temperature_u_k)));
  }
  if (sources.scan == nullptr) {
    conditions.emplace_back("rig and calibration",
                            words("not stated: the scan of the mesh was not named"));
    return conditions;
  }
  const Scan& scan = *sources.scan;
  conditions.emplace_back("scan", scan.folder.filename().string());
  const auto& calibration = scan.rig.calibration;
  conditions.emplace_back("calibrated", calibration ? calibration->date : words("date not known"));
  if (calibration) {
    conditions.emplace_back(
        "uncertainty of a point by the calibration",
        words(fmt::format(
            "{:.4f} mm at {:.0f} mm", calibration->point_sigma_mm, calibration->distance_mm)));
  }
  for (const char* name : {"scan.toml", "rig.toml"}) {
    const auto path = scan.folder / name;
    if (std::filesystem::exists(path))
      conditions.emplace_back(fmt::format("SHA-256 of {}", name), sha256_of_file(path));
  }
  return conditions;
}

NamedTexts alignment_rows(const Inspection& part, const ReportWords& words) {
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
  for (std::size_t i = 0; i < part.points_mm.size(); ++i)
    rows.emplace_back(fmt::format("pair of points {}, mm apart", i + 1),
                      fmt::format("{:.4f}", part.points_mm[i]));
  for (const std::string& direction : part.alignment->free_directions)
    rows.emplace_back("not determined by the shape", words(direction));
  return rows;
}

/// The name of a section as a part of the name of a file, other than those of the sections before
/// it: characters that are replaced may make two names alike.
std::string file_name_part(const std::string& name, std::set<std::string>& taken) {
  constexpr std::size_t kMost = 100;  // a file system allows 255 with what stands around it
  std::string safe;
  for (const char c : name.substr(0, kMost))
    safe += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.' ? c : '-';
  std::string other = safe;
  for (int i = 2; !taken.insert(other).second; ++i)
    other = fmt::format("{}-{}", safe, i);
  return other;
}

std::string created_now() {
  return fmt::format(
      "{:%Y-%m-%d %H:%M:%S} UTC",
      fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())));
}

/// The inspection as JSON, with what the report adds.
std::string json_of(const Inspection& part, const InspectionReport& report) {
  auto json = nlohmann::ordered_json::parse(inspection_json(part));
  json["verdict"] = name_of(part.verdict);
  json["created"] = report.created;
  json["version"] = report.version;
  return json.dump(2, ' ', true, nlohmann::json::error_handler_t::replace) + "\n";
}

/// The names that the plan has for a feature.
std::string names_in_plan(const Inspection& part, const Shape& shape) {
  std::string names;
  for (const NamedFeature& named : part.named_features) {
    if (named.shape.kind == shape.kind && named.shape.center_mm == shape.center_mm)
      names += (names.empty() ? "" : ", ") + named.name;
  }
  return names;
}

/// The features with their names and numbers. Where surfaces meet is listed if the plan names it.
void add_features(InspectionReport& report, const Inspection& part, const Run& run) {
  std::vector<std::string> kinds;
  for (std::size_t i = 0; i < part.features.size(); ++i) {
    const Shape& shape = part.features[i].fit.shape;
    std::string name = names_in_plan(part, shape);
    if (!is_surface(shape.kind) && name.empty()) continue;
    report.features.push_back(part.features[i]);
    report.feature_names.push_back(std::move(name));
    if (!part.nominals.empty()) report.nominals.push_back(part.nominals[i]);
    kinds.emplace_back(name_of(shape.kind));
  }
  report.feature_pictures =
      feature_pictures(part.mesh, report.features, kinds, report.pictures, run);
}

}  // namespace

InspectionReport report_of(const Inspection& part,
                           const InspectionPlan& plan,
                           const ReportSources& sources,
                           const Run& run) {
  run.stage("report");
  InspectionReport report;
  report.part = plan.part;
  report.fields = plan.report;
  if (!plan.report.logo.empty()) report.logo = read_logo(plan.report.logo);
  report.mesh = sources.mesh.filename().string();
  report.reference = reference_name(sources);
  report.created = created_now();
  report.version = sources.version;
  report.conditions = conditions_of(plan, sources);
  report.alignment = alignment_rows(part, ReportWords(plan.report.language));
  if (part.surface) {
    report.deviation = part.surface->summary;
    report.surface = part.surface->verdict;
  }
  if (part.walls) report.thickness = part.walls->summary;
  report.pictures = report_pictures(part, sources.scale_mm, run);
  report.characteristics = part.characteristics;
  add_features(report, part, run);
  report.sections = part.sections;
  for (const SectionResult& section : part.sections) {
    report.dimensions.push_back(
        section_dimensions(section.plane, part.named_features, part.characteristics));
  }
  report.uncertainty_mm = uncertainty_terms_of(part);
  report.systematic_known = !part.mesh.sigma_systematic_mm.empty();
  report.correlation_known = part.knows_calibration;
  report.warnings = part.warnings;
  for (const std::string& warning : sources.warnings) {
    if (std::find(report.warnings.begin(), report.warnings.end(), warning) == report.warnings.end())
      report.warnings.push_back(warning);
  }
  return report;
}

std::vector<std::string> write_report(const std::filesystem::path& page,
                                      const Inspection& part,
                                      const InspectionPlan& plan,
                                      const ReportSources& sources,
                                      const Run& run) {
  const InspectionReport report = report_of(part, plan, sources, run);
  std::vector<std::string> written;
  const auto write = [&](const std::filesystem::path& path, const std::string& text) {
    write_text_file(path, text);
    written.push_back(path.string());
  };
  const auto beside = [&](const std::string& ending) {
    std::filesystem::path path = page;
    return path.replace_extension(ending);
  };
  std::set<std::string> taken;
  for (std::size_t i = 0; i < part.sections.size(); ++i) {
    const SectionResult& section = part.sections[i];
    if (section.measured.empty()) continue;
    const std::string stem = page.stem().string() + "-" + file_name_part(section.name, taken);
    write(page.parent_path() / (stem + ".svg"),
          svg_of(section, report.dimensions[i], ReportWords(plan.report.language)));
    write(page.parent_path() / (stem + ".dxf"), dxf_of(section));
  }
  if (!part.characteristics.empty()) write(beside(".csv"), csv_of(part.characteristics));
  write(beside(".json"), json_of(part, report));
  write(page, html_of(report));
  return written;
}

}  // namespace frangia
