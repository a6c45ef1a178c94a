#include "frangia/service/part_series.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/inspection/write_inspection_plan.h"
#include "frangia/service/acceptance_record.h"

namespace frangia {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSeries = "series.json";
constexpr const char* kResults = "results.json";
constexpr std::size_t kMostRows = 1000;
constexpr std::size_t kMostPartName = 200;

Json limit_or_null(double limit) {
  return std::isfinite(limit) ? Json(limit) : Json();
}

Json json_of_series_row(const MeasuredCharacteristic& row) {
  return {{"name", row.name},
          {"unit", row.unit},
          {"nominal", row.nominal ? Json(*row.nominal) : Json()},
          {"limits",
           row.limits ? Json{limit_or_null(row.limits->lower), limit_or_null(row.limits->upper)}
                      : Json()},
          {"value", row.value},  // NaN is written as null
          {"u95", row.u95},
          {"verdict", row.limits ? Json(name_of(row.conformity)) : Json()}};
}

Json json_of_part(const SeriesPart& part) {
  Json rows = Json::array();
  for (const MeasuredCharacteristic& row : part.rows)
    rows.push_back(json_of_series_row(row));
  return {{"name", part.project},
          {"serial", part.serial},
          {"verdict", part.verdict.empty() ? Json() : Json(part.verdict)},
          {"rows", std::move(rows)}};
}

double number_of(const nlohmann::json& json, double otherwise) {
  return json.is_null() ? otherwise : json.get<double>();
}

/// @errors   std::exception for another content than `json_of_part` writes
SeriesPart part_of(const nlohmann::json& json) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  SeriesPart part{.project = {},
                  .serial = json.at("serial").get<std::string>(),
                  .verdict = json.at("verdict").get<std::string>(),
                  .rows = {}};
  for (const auto& one : json.at("rows")) {
    if (part.rows.size() == kMostRows) break;
    MeasuredCharacteristic row;
    row.name = one.at("name").get<std::string>();
    row.unit = one.at("unit").get<std::string>();
    if (!one.at("nominal").is_null()) row.nominal = one.at("nominal").get<double>();
    row.value = number_of(one.at("value"), kMissing);
    row.u95 = number_of(one.at("u95"), kMissing);
    if (const auto& limits = one.at("limits"); !limits.is_null()) {
      row.limits = ToleranceLimits{number_of(limits.at(0), -kNone), number_of(limits.at(1), kNone)};
      row.conformity = value_named<Conformity>("verdict", one.at("verdict").get<std::string>());
    }
    part.rows.push_back(std::move(row));
  }
  return part;
}

/// Names of the projects of the parts before, the oldest first.
std::vector<std::string> names_before(const ProjectFolder& project) {
  try {
    std::vector<std::string> names;
    const auto json = nlohmann::json::parse(project.read_json(kSeries));
    for (const auto& name : json.at("parts"))
      if (name.get<std::string>().size() <= kMostPartName) names.push_back(name.get<std::string>());
    return names;
  } catch (const std::exception&) {
    return {};  // it is the first part
  }
}

void write_json(const std::filesystem::path& path, const Json& json) {
  make_folder(path.parent_path());
  write_text_file(
      path, json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n", Durability::Synced);
}

void copy_if_there(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(from, error)) return;
  make_folder(to.parent_path());
  std::filesystem::copy_file(from, to, error);
  if (error) {
    throw Error(ErrorKind::File,
                fmt::format("{}: cannot be copied: {}", from.string(), error.message()));
  }
}

/// The reference and its name.
void copy_reference(const ProjectFolder& from, const ProjectFolder& to) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(from.reference_name(), ignored)) return;
  const auto named = nlohmann::json::parse(from.read_json("reference.json"));
  const std::string format = named.at("format");
  const int number = named.value("number", 0);
  copy_if_there(from.reference(format, number), to.reference(format, number));
  copy_if_there(from.reference_name(), to.reference_name());
}

}  // namespace

void write_series_results(const ProjectFolder& project,
                          const Inspection& found,
                          const InspectionPlan& plan) {
  write_json(project.in_derived(kResults),
             json_of_part({.project = project.name,
                           .serial = plan.report.serial,
                           .verdict = std::string(name_of(found.verdict)),
                           .rows = found.characteristics}));
}

void prepare_next_part(const ProjectFolder& before,
                       const std::optional<InspectionPlan>& plan,
                       const ProjectFolder& next) {
  copy_if_there(before.rig(), next.rig());
  copy_if_there(before.in_folder("true-rig.toml"), next.in_folder("true-rig.toml"));
  copy_if_there(before.capture(), next.capture());
  copy_reference(before, next);
  copy_acceptance(before, next);
  if (plan) {
    InspectionPlan same = *plan;
    same.report.serial.clear();
    same.report.date.clear();
    make_folder(next.derived);
    write_inspection_plan(next.plan(), same);
  }
  std::vector<std::string> parts = names_before(before);
  parts.push_back(before.name);
  if (parts.size() > kMostSeriesParts)
    parts.erase(parts.begin(), parts.end() - static_cast<std::ptrdiff_t>(kMostSeriesParts));
  write_json(next.in_derived(kSeries),
             {{"format", "frangia-series"}, {"version", 1}, {"parts", parts}});
}

std::vector<SeriesPart> read_series(const ProjectLibrary& library, const ProjectFolder& project) {
  std::vector<SeriesPart> series;
  for (const std::string& name : names_before(project)) {
    if (series.size() == kMostSeriesParts) break;
    try {
      const ProjectFolder folder = library.find(name);
      SeriesPart part;
      try {
        part = part_of(nlohmann::json::parse(folder.read_json(kResults)));
      } catch (const std::exception&) {  // NOLINT(bugprone-empty-catch): it was not inspected
      }
      part.project = name;
      series.push_back(std::move(part));
    } catch (const Error&) {  // NOLINT(bugprone-empty-catch): it was deleted
    }
  }
  return series;
}

nlohmann::ordered_json json_of(const std::vector<SeriesPart>& series) {
  Json all = Json::array();
  for (const SeriesPart& part : series)
    all.push_back(json_of_part(part));
  return all;
}

}  // namespace frangia
