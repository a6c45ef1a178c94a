#include "frangia/inspection/write_inspection_plan.h"

#include <sstream>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include "frangia/core/durable_file.h"

namespace frangia {
namespace {

std::string quoted(const std::string& text) {
  const toml::value<std::string> value(text);
  const auto flags =
      toml::toml_formatter::default_flags & ~toml::format_flags::allow_literal_strings;
  std::ostringstream out;
  out << toml::toml_formatter(value, flags);
  return out.str();
}

/// Lines `key = value` of one table.
class TomlLines {
 public:
  void raw(std::string_view key, const std::string& value) {
    text_ += fmt::format("{} = {}\n", key, value);
  }
  void text(std::string_view key, const std::string& value) {
    if (!value.empty()) raw(key, quoted(value));
  }
  void number(std::string_view key, double value) { raw(key, fmt::format("{}", value)); }
  void number(std::string_view key, const std::optional<double>& value) {
    if (value) number(key, *value);
  }
  /// A number that is left out where it is `usual`.
  void number_unless(std::string_view key, double value, double usual) {
    if (value != usual) number(key, value);
  }
  void vector(std::string_view key, const Eigen::Vector3d& v) {
    raw(key, fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z()));
  }
  void limits(std::string_view key, const std::optional<ToleranceLimits>& limits) {
    if (limits) raw(key, fmt::format("[{}, {}]", limits->lower, limits->upper));
  }
  void head(std::string_view line) { text_ += fmt::format("\n{}\n", line); }
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

std::string relative_to(const std::filesystem::path& path, const std::filesystem::path& folder) {
  if (path.empty()) return {};
  const auto relative = path.lexically_relative(folder);
  const bool below = !relative.empty() && *relative.begin() != "..";
  return (below ? relative : path).string();
}

void add_feature(TomlLines& lines, const PlannedFeature& feature) {
  lines.head("[[features]]");
  lines.text("name", feature.name);
  if (feature.face > 0) {
    lines.raw("face", std::to_string(feature.face));
  } else {
    lines.text("kind", std::string(name_of(feature.kind)));
    lines.vector("near_mm", feature.near_mm);
  }
  lines.number("diameter_mm", feature.diameter_mm);
  lines.limits("tolerance_mm", feature.tolerance_mm);
  for (const auto& [form, limit] : feature.forms_mm)
    lines.number(std::string(name_of(form)) + "_mm", limit);
  if (feature.form == FormReference::MinimumZone) lines.text("fit", "minimum-zone");
}

void add_characteristic(TomlLines& lines, const PlannedCharacteristic& planned) {
  lines.head("[[characteristics]]");
  lines.text("name", planned.name);
  lines.text("kind", std::string(name_of(planned.kind)));
  lines.text("feature", planned.feature);
  lines.text("section", planned.section);
  lines.text("datum", planned.datum);
  if (planned.kind == Characteristic::Position) lines.vector("position_mm", planned.position_mm);
  lines.number("nominal", planned.nominal);
  lines.limits("tolerance", planned.tolerance);
  lines.number("limit", planned.limit);
}

void add_surface_rule(TomlLines& lines, const SurfaceRule& rule) {
  const SurfaceRule usual;
  lines.number_unless("min_feature_mm", rule.min_feature_mm, usual.min_feature_mm);
  lines.number("edge_mm", rule.edge_mm);
  lines.number_unless(
      "max_uncertainty_share", rule.max_uncertainty_share, usual.max_uncertainty_share);
  lines.number_unless("min_coverage", rule.min_coverage, usual.min_coverage);
  lines.number_unless("max_gap_mm", rule.max_gap_mm, usual.max_gap_mm);
}

void add_report(TomlLines& lines, const ReportFields& fields, const std::filesystem::path& folder) {
  TomlLines inner;
  inner.text("drawing", fields.drawing);
  inner.text("order", fields.order);
  inner.text("serial", fields.serial);
  inner.text("customer", fields.customer);
  inner.text("operator", fields.inspector);
  inner.text("date", fields.date);
  if (fields.paper != ReportFields{}.paper) inner.text("paper", fields.paper);
  if (fields.language != ReportFields{}.language) inner.text("language", fields.language);
  inner.text("logo", relative_to(fields.logo, folder));
  if (fields.pages) {
    std::vector<std::string> names;
    for (const ReportPage page : *fields.pages)
      names.push_back(fmt::format("\"{}\"", name_of(page)));
    inner.raw("pages", fmt::format("[{}]", fmt::join(names, ", ")));
  }
  const std::string text = inner.take();
  if (!text.empty()) lines.head("[report]\n" + text.substr(0, text.size() - 1));
}

}  // namespace

std::string inspection_plan_text(const InspectionPlan& plan, const std::filesystem::path& folder) {
  TomlLines lines;
  lines.text("format", "frangia-inspection");
  lines.raw("version", "1");
  lines.text("part", plan.part);
  lines.text("reference", relative_to(plan.reference, folder));
  if (plan.unit_mm) lines.text("units", fmt::format("{}mm", *plan.unit_mm));
  lines.text("align", plan.align);
  if (!plan.datums.empty()) {
    std::vector<std::string> names;
    for (const std::string& name : plan.datums)
      names.push_back(quoted(name));
    lines.raw("datums", fmt::format("[{}]", fmt::join(names, ", ")));
  }
  if (plan.start > 0) lines.raw("start", std::to_string(plan.start));
  lines.limits("tolerance_mm", plan.tolerance_mm);
  add_surface_rule(lines, plan.surface);
  if (plan.thickness) lines.raw("thickness", "true");
  lines.number_unless("expansion_ppm_per_k", plan.expansion_ppm_per_k, 0.0);
  lines.number_unless("temperature_u_k", plan.temperature_u_k, 0.0);
  for (const PointPair& pair : plan.points) {
    lines.head("[[points]]");
    lines.vector("scan_mm", pair.scan_mm);
    lines.vector("reference_mm", pair.reference_mm);
  }
  for (const PlannedFeature& feature : plan.features)
    add_feature(lines, feature);
  for (const PlannedCharacteristic& planned : plan.characteristics)
    add_characteristic(lines, planned);
  for (const ExcludedBox& box : plan.surface.excluded) {
    lines.head("[[excluded]]");
    lines.text("name", box.name);
    lines.vector("min_mm", box.min_mm);
    lines.vector("max_mm", box.max_mm);
  }
  for (const PlannedSection& section : plan.sections) {
    lines.head("[[sections]]");
    lines.text("name", section.name);
    lines.vector("point_mm", section.point_mm);
    lines.vector("normal", section.normal);
    if (section.blade) lines.raw("blade", "true");
  }
  add_report(lines, plan.report, folder);
  return lines.take();
}

std::string inspection_plan_json(const InspectionPlan& plan, const std::filesystem::path& folder) {
  const toml::table table = toml::parse(inspection_plan_text(plan, folder));
  std::ostringstream out;
  out << toml::json_formatter{table};
  return out.str();
}

void write_inspection_plan(const std::filesystem::path& path, const InspectionPlan& plan) {
  write_text_file(path, inspection_plan_text(plan, path.parent_path()));
}

}  // namespace frangia
