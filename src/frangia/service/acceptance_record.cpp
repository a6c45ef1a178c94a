#include "frangia/service/acceptance_record.h"

#include <cmath>
#include <exception>
#include <utility>

#include <nlohmann/json.hpp>

#include "frangia/acceptance/frame_checksums.h"
#include "frangia/acceptance/measure_balls.h"
#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/core/open_below.h"

namespace frangia {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kPlan = "acceptance.toml";
constexpr const char* kResult = "acceptance.json";
constexpr std::size_t kMostAcceptanceBytes = 20'000;
constexpr std::size_t kMostWarnings = 20;

Json json_of_measured(const ArrangementResult& result, const std::vector<std::string>& warnings) {
  Json balls = Json::array();
  for (const MeasuredBall& ball : result.measured.balls) {
    balls.push_back({{"diameter_mm", ball.diameter_mm},
                     {"form_95_mm", ball.form_95_mm},
                     {"form_all_mm", ball.form_all_mm},
                     {"points", ball.points},
                     {"seen", ball.seen}});
  }
  return {{"format", "frangia-arrangement"},
          {"version", 1},
          {"name", result.name},
          {"files", result.frames},
          {"sha256", result.frames_sha256},
          {"balls", std::move(balls)},
          {"spacing_mm", result.measured.spacing_mm},
          {"length_mm", result.measured.length_mm},  // NaN is written as null
          {"warnings", warnings}};
}

/// @errors   std::exception for another content than `json_of_measured` writes
MeasuredArrangement arrangement_of(const nlohmann::json& json, std::size_t balls) {
  MeasuredArrangement found;
  found.result.name = json.at("name").get<std::string>();
  found.result.frames = json.at("files").get<std::size_t>();
  found.result.frames_sha256 = json.at("sha256").get<std::string>();
  for (const auto& one : json.at("balls")) {
    MeasuredBall ball;
    ball.diameter_mm = one.at("diameter_mm").get<double>();
    ball.form_95_mm = one.at("form_95_mm").get<double>();
    ball.form_all_mm = one.at("form_all_mm").get<double>();
    ball.points = one.at("points").get<std::size_t>();
    ball.seen = one.at("seen").get<double>();
    found.result.measured.balls.push_back(ball);
  }
  if (found.result.measured.balls.size() != balls)
    throw Error(ErrorKind::Input, "the arrangement has another number of balls than the artifact");
  found.result.measured.spacing_mm = json.at("spacing_mm").get<double>();
  const auto& length = json.at("length_mm");
  found.result.measured.length_mm = length.is_null() ? kMissing : length.get<double>();
  for (const auto& warning : json.at("warnings")) {
    if (found.warnings.size() < kMostWarnings) found.warnings.push_back(warning.get<std::string>());
  }
  return found;
}

Json optional_number(const std::optional<double>& value) {
  return value ? Json(*value) : Json();
}

Json json_of_plan(const AcceptancePlan& plan) {
  const ReferenceArtifact& artifact = plan.artifact;
  std::string operator_name;
  for (const auto& [key, text] : plan.conditions)
    if (key == "operator") operator_name = text;
  return {{"artifact",
           {{"diameters_mm", artifact.diameters_mm},
            {"spacing_mm", artifact.spacing_mm > 0.0 ? Json(artifact.spacing_mm) : Json()},
            {"u95_mm", artifact.u95_mm},
            {"form_mm", artifact.form_mm},
            {"expansion_ppm_per_k", artifact.expansion_ppm_per_k},
            {"certificate", artifact.certificate}}},
          {"limits",
           {{"probing_form_mm", optional_number(plan.limits.probing_form_mm)},
            {"probing_size_mm", optional_number(plan.limits.probing_size_mm)},
            {"sphere_spacing_mm", optional_number(plan.limits.sphere_spacing_mm)},
            {"length_mm", optional_number(plan.limits.length_mm)}}},
          {"volume_mm",
           plan.volume_mm ? Json{plan.volume_mm->x(), plan.volume_mm->y(), plan.volume_mm->z()}
                          : Json()},
          {"temperature_c", plan.temperature_c},
          {"temperature_u_k", plan.temperature_u_k},
          {"operator", operator_name}};
}

}  // namespace

void write_acceptance(const ProjectFolder& project, const std::string& text) {
  if (text.empty()) {
    std::filesystem::remove(project.in_derived(kResult));
    std::filesystem::remove(project.in_derived(kPlan));
    return;
  }
  require(text.size() <= kMostAcceptanceBytes,
          "the plan of a test has at most 20 kB; shorten its texts");
  static_cast<void>(parse_acceptance_plan(text, "the test"));
  make_folder(project.derived);
  write_text_file(project.in_derived(kPlan), text, Durability::Synced);
}

void measure_arrangement(const ProjectFolder& project,
                         const AcceptancePlan& plan,
                         const std::string& name,
                         const Mesh& mesh,
                         const std::vector<std::string>& warnings,
                         const Run& run) {
  run.stage("balls");
  ArrangementResult result;
  result.name = name;
  result.measured = measure_balls(mesh, plan.artifact, run);
  const FrameChecksums frames = frame_checksums(project.scan, run);
  result.frames = frames.files;
  result.frames_sha256 = frames.sha256;
  write_text_file(
      project.in_derived(kResult),
      json_of_measured(result, warnings).dump(-1, ' ', false, Json::error_handler_t::replace) +
          "\n",
      Durability::Synced);
}

void copy_acceptance(const ProjectFolder& before, const ProjectFolder& next) {
  std::error_code ignored;
  if (!std::filesystem::exists(before.in_derived(kPlan), ignored)) return;
  write_acceptance(next, read_below(before.derived, kPlan, kMostAcceptanceBytes));
}

std::optional<AcceptanceRecord> read_acceptance(const ProjectLibrary& library,
                                                const ProjectFolder& project) {
  AcceptanceRecord record;
  try {
    std::error_code ignored;
    if (!std::filesystem::exists(project.in_derived(kPlan), ignored)) return std::nullopt;
    record.plan =
        parse_acceptance_plan(read_below(project.derived, kPlan, kMostAcceptanceBytes), "the test");
  } catch (const Error&) {
    return std::nullopt;  // damaged: it is stated again
  }
  const auto add = [&](const ProjectFolder& folder) {
    try {
      MeasuredArrangement found = arrangement_of(nlohmann::json::parse(folder.read_json(kResult)),
                                                 record.plan.artifact.diameters_mm.size());
      found.project = folder.name;
      found.result.scan = folder.scan.string();
      record.plan.arrangements.push_back({.name = found.result.name, .scan = folder.scan});
      record.arrangements.push_back(std::move(found));
    } catch (const std::exception&) {  // NOLINT(bugprone-empty-catch): it was not measured
    }
  };
  for (const SeriesPart& part : read_series(library, project)) {
    try {
      add(library.find(part.project));
    } catch (const Error&) {  // NOLINT(bugprone-empty-catch): it was deleted
    }
  }
  add(project);
  return record;
}

std::vector<ArrangementResult> results_at_20(const AcceptanceRecord& record) {
  std::vector<ArrangementResult> results;
  for (const MeasuredArrangement& one : record.arrangements) {
    results.push_back(one.result);
    results.back().measured = at_reference_temperature(one.result.measured, record.plan);
  }
  return results;
}

nlohmann::ordered_json json_of(const AcceptanceRecord& record) {
  Json json = json_of_plan(record.plan);
  json["arrangements"] = Json::array();
  for (const MeasuredArrangement& one : record.arrangements) {
    json["arrangements"].push_back(
        {{"name", one.result.name}, {"project", one.project}, {"warnings", one.warnings}});
  }
  json["quantities"] = Json::array();
  json["verdict"] = Json();
  json["incomplete"] = Json::array();
  if (record.arrangements.empty()) return json;
  const AcceptanceResult result = acceptance_result(record.plan, results_at_20(record));
  for (const AcceptanceQuantity& quantity : result.quantities) {
    json["quantities"].push_back(
        {{"symbol", quantity.symbol},
         {"error_mm", quantity.error_mm},
         {"u95_mm", quantity.u95_mm},
         {"limit_mm", optional_number(quantity.limit_mm)},
         {"verdict", quantity.limit_mm ? Json(name_of(quantity.conformity)) : Json()},
         {"arrangement", quantity.arrangement}});
  }
  if (result.judged) json["verdict"] = name_of(result.conformity);
  json["incomplete"] = result.incomplete;
  return json;
}

}  // namespace frangia
