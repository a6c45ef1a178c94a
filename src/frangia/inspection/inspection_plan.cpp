#include "frangia/inspection/inspection_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/parse_length.h"
#include "frangia/rig/toml_reader.h"

namespace frangia {
namespace {

Eigen::Vector3d vector_of(TomlReader& reader, std::string_view key) {
  const std::vector<double> values = reader.numbers(key, 3);
  return {values[0], values[1], values[2]};
}

std::optional<ToleranceLimits> limits_of(TomlReader& reader, std::string_view key) {
  if (!reader.has(key)) return std::nullopt;
  const std::vector<double> values = reader.numbers(key, 2);
  if (values[0] == values[1])
    reader.fail(key, "has no width, which no part and no measurement keeps; state [LOWER, UPPER]");
  if (!(values[0] < values[1])) reader.fail(key, "must be [LOWER, UPPER], the lower one first");
  return ToleranceLimits{values[0], values[1]};
}

PlannedFeature feature_of(TomlReader& reader) {
  PlannedFeature feature;
  feature.name = reader.text("name");
  // A face of the CAD reference states what is not stated here.
  if (reader.has("face"))
    feature.face = static_cast<std::size_t>(reader.integer("face", 1, 1'000'000));
  if (feature.face == 0) {
    feature.kind = reader.named<ShapeKind>("kind");
    feature.near_mm = vector_of(reader, "near_mm");
  } else {
    for (const char* key : {"kind", "near_mm"}) {
      if (reader.has(key))
        reader.fail(key, "is stated by the face of the CAD reference; leave it out");
    }
  }
  if (reader.has("diameter_mm")) feature.diameter_mm = reader.positive("diameter_mm");
  feature.tolerance_mm = limits_of(reader, "tolerance_mm");
  if (reader.has("fit")) feature.form = reader.named<FormReference>("fit");
  for (const Characteristic form :
       {Characteristic::Flatness, Characteristic::Roundness, Characteristic::Cylindricity}) {
    const std::string key = std::string(name_of(form)) + "_mm";
    if (reader.has(key)) feature.forms_mm[form] = reader.positive(key);
  }
  return feature;
}

PlannedCharacteristic characteristic_from(TomlReader& reader) {
  PlannedCharacteristic planned;
  planned.name = reader.text("name");
  planned.kind = reader.named<Characteristic>("kind");
  const bool is_line = planned.kind == Characteristic::LineProfile;
  if (is_line) planned.section = reader.text("section");
  const bool may_be_all = is_of_surface(planned.kind);
  if (!is_line && (!may_be_all || reader.has("feature"))) planned.feature = reader.text("feature");
  if (needs_datum(planned.kind)) planned.datum = reader.text("datum");
  if (planned.kind == Characteristic::Position)
    planned.position_mm = vector_of(reader, "position_mm");
  if (has_nominal(planned.kind)) {
    if (reader.has("nominal")) planned.nominal = reader.number("nominal");
    planned.tolerance = limits_of(reader, "tolerance");
    if (planned.tolerance && !planned.nominal) {
      reader.refuse_unused_keys();  // a misspelt nominal
      reader.fail("tolerance", "is of the difference from the nominal value; state nominal");
    }
  } else if (reader.has("limit")) {
    planned.limit = reader.positive("limit");
  }
  return planned;
}

PlannedSection section_of(TomlReader& reader) {
  PlannedSection section;
  section.name = reader.text("name");
  section.point_mm = vector_of(reader, "point_mm");
  section.normal = vector_of(reader, "normal");
  if (!(section.normal.norm() > 1e-9)) reader.fail("normal", "must not be zero");
  section.normal.normalize();
  if (reader.has("blade")) section.blade = reader.boolean("blade");
  return section;
}

ExcludedBox excluded_of(TomlReader& reader) {
  ExcludedBox box;
  box.name = reader.text("name");
  box.min_mm = vector_of(reader, "min_mm");
  box.max_mm = vector_of(reader, "max_mm");
  if (!(box.min_mm.array() < box.max_mm.array()).all())
    reader.fail("max_mm", "must be larger than min_mm along x, y and z");
  return box;
}

void read_surface_rule(TomlReader& top, SurfaceRule& rule) {
  const auto share = [&](std::string_view key, double& value) {
    if (!top.has(key)) return;
    value = top.positive(key);
    if (value > 1.0) top.fail(key, "must be 1 at most");
  };
  if (top.has("min_feature_mm")) rule.min_feature_mm = top.positive("min_feature_mm");
  if (top.has("max_gap_mm")) rule.max_gap_mm = top.positive("max_gap_mm");
  if (top.has("edge_mm")) {
    rule.edge_mm = top.number("edge_mm");
    if (*rule.edge_mm < 0.0) top.fail("edge_mm", "must be 0 or more");
  }
  share("max_uncertainty_share", rule.max_uncertainty_share);
  share("min_coverage", rule.min_coverage);
}

ReportFields report_of(TomlReader reader, const std::filesystem::path& plan) {
  ReportFields fields;
  const auto text = [&](std::string_view key, std::string& value) {
    if (reader.has(key)) value = reader.text(key);
  };
  text("drawing", fields.drawing);
  text("order", fields.order);
  text("serial", fields.serial);
  text("customer", fields.customer);
  text("operator", fields.inspector);
  text("date", fields.date);
  text("paper", fields.paper);
  if (fields.paper != "A4" && fields.paper != "Letter")
    reader.fail("paper", fmt::format("is \"{}\"; it must be A4 or Letter", fields.paper));
  text("language", fields.language);
  if (std::find(kReportLanguages.begin(), kReportLanguages.end(), fields.language) ==
      kReportLanguages.end()) {
    reader.fail(
        "language",
        fmt::format(
            "is \"{}\"; it must be one of {}", fields.language, fmt::join(kReportLanguages, ", ")));
  }
  if (reader.has("logo")) fields.logo = plan.parent_path() / reader.text("logo");
  if (reader.has("pages")) {
    fields.pages.emplace();
    for (const std::string& name : reader.texts("pages")) {
      const auto page = find_named<ReportPage>(name);
      if (!page) {
        reader.fail(
            "pages",
            fmt::format(
                "is \"{}\"; it must be one of {}", name, fmt::join(all_names<ReportPage>(), ", ")));
      }
      fields.pages->push_back(*page);
    }
  }
  reader.refuse_unused_keys();
  return fields;
}

/// Reads the tables of a key and checks that no two have the same name.
template <typename Item, typename Read>
std::vector<Item> items_of(TomlReader& top, std::string_view key, const Read& read) {
  std::vector<Item> items;
  std::set<std::string> names;
  for (TomlReader& reader : top.tables(key)) {
    items.push_back(read(reader));
    if (!names.insert(items.back().name).second)
      reader.fail("name", fmt::format("\"{}\" is not unique", items.back().name));
    reader.refuse_unused_keys();
  }
  return items;
}

void read_surface_keys(TomlReader& top, InspectionPlan& plan) {
  if (top.has("part")) plan.part = top.text("part");
  if (top.has("reference")) plan.reference = top.text("reference");
  if (top.has("units")) {
    const std::string units = top.text("units");
    plan.unit_mm = parse_unit_mm(units);
    if (!plan.unit_mm)
      top.fail("units", fmt::format("is \"{}\"; it must be {}", units, kUnitsKnown));
  }
  if (top.has("align")) plan.align = top.text("align");
  const bool known =
      std::find(kAlignments.begin(), kAlignments.end(), plan.align) != kAlignments.end();
  if (!plan.align.empty() && !known) {
    top.fail(
        "align",
        fmt::format("is \"{}\"; it must be one of {}", plan.align, fmt::join(kAlignments, ", ")));
  }
  if (top.has("start")) plan.start = static_cast<std::size_t>(top.integer("start", 1, 1000));
  plan.tolerance_mm = limits_of(top, "tolerance_mm");
  read_surface_rule(top, plan.surface);
  if (top.has("thickness")) plan.thickness = top.boolean("thickness");
  plan.expansion_ppm_per_k = top.number_or("expansion_ppm_per_k", 0.0);
  plan.temperature_u_k = top.number_or("temperature_u_k", 0.0);
  if (plan.expansion_ppm_per_k < 0.0) top.fail("expansion_ppm_per_k", "must be 0 or more");
  if (plan.temperature_u_k < 0.0) top.fail("temperature_u_k", "must be 0 or more");
}

}  // namespace

bool ReportFields::prints(ReportPage page) const {
  return !pages || std::find(pages->begin(), pages->end(), page) != pages->end();
}

ToleranceLimits InspectionPlan::tolerance() const {
  constexpr double kUsual_mm = 0.1;
  return tolerance_mm.value_or(ToleranceLimits{-kUsual_mm, kUsual_mm});
}

double InspectionPlan::overlap_tolerance_mm() const {
  if (!tolerance_mm) return 0.0;
  return std::max(std::abs(tolerance_mm->lower), std::abs(tolerance_mm->upper));
}

std::filesystem::path InspectionPlan::name() const {
  return file.empty() ? std::filesystem::path("the plan") : file;
}

InspectionPlan read_inspection_plan(const std::filesystem::path& path) {
  return parse_inspection_plan(read_text_file(path), path);
}

InspectionPlan parse_inspection_plan(const std::string& text, const std::filesystem::path& path) {
  const toml::table table = parse_toml_text_as(text, path, "frangia-inspection");
  TomlReader top(path, "", table);
  top.ignore("format");
  top.ignore("version");
  InspectionPlan plan;
  plan.file = path;
  read_surface_keys(top, plan);
  if (!plan.reference.empty() && plan.reference.is_relative())
    plan.reference = path.parent_path() / plan.reference;
  plan.features = items_of<PlannedFeature>(top, "features", feature_of);
  plan.characteristics =
      items_of<PlannedCharacteristic>(top, "characteristics", characteristic_from);
  plan.surface.excluded = items_of<ExcludedBox>(top, "excluded", excluded_of);
  plan.sections = items_of<PlannedSection>(top, "sections", section_of);
  if (top.has("report")) plan.report = report_of(top.table("report"), path);
  const auto is_named = [&](const std::string& name) {
    return std::any_of(plan.features.begin(), plan.features.end(), [&](const auto& feature) {
      return feature.name == name;
    });
  };
  for (TomlReader& reader : top.tables("points")) {
    plan.points.push_back({vector_of(reader, "scan_mm"), vector_of(reader, "reference_mm")});
    reader.refuse_unused_keys();
  }
  if (plan.points.size() < (plan.align == "points" ? 3U : plan.points.empty() ? 0U : 3U))
    top.fail("points", "needs three pairs or more, each with scan_mm and reference_mm");
  if (top.has("datums")) plan.datums = top.texts("datums");
  top.refuse_unused_keys();  // first: what a misspelt key holds is missing below
  if ((plan.align == "datum" && plan.datums.empty()) || plan.datums.size() > 3)
    top.fail("datums", "must name one to three of [[features]], in their order");
  for (const std::string& name : plan.datums) {
    if (!is_named(name))
      top.fail("datums", fmt::format("names \"{}\", which is no name of [[features]]", name));
  }
  for (const PlannedCharacteristic& planned : plan.characteristics) {
    const bool has_section =
        planned.section.empty() ||
        std::any_of(plan.sections.begin(), plan.sections.end(), [&](const PlannedSection& section) {
          return section.name == planned.section;
        });
    if (!has_section) {
      top.fail("characteristics",
               fmt::format("\"{}\" refers to \"{}\", which is no name of [[sections]]",
                           planned.name,
                           planned.section));
    }
    for (const std::string& name : {planned.feature, planned.datum}) {
      if (name.empty() || is_named(name)) continue;
      top.fail(
          "characteristics",
          fmt::format(
              "\"{}\" refers to \"{}\", which is no name of [[features]]", planned.name, name));
    }
  }
  return plan;
}

}  // namespace frangia
