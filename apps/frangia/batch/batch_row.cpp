#include "batch/batch_row.h"

#include <cmath>
#include <cstdint>
#include <limits>

namespace frangia {
namespace {

using Json = nlohmann::ordered_json;

/// A number of another kind, such as 1e300, is left out.
template <typename Count>
void take_count(const Json& json, const char* key, Count& count) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_number_unsigned()) return;
  const auto value = found->get<std::uint64_t>();
  if (value <= static_cast<std::uint64_t>(std::numeric_limits<Count>::max()))
    count = static_cast<Count>(value);
}

}  // namespace

void take_results(const nlohmann::ordered_json& results, BatchRow& row) {
  if (!results.is_object()) return;
  take_count(results, "points", row.points);
  take_count(results, "triangles", row.triangles);
  const auto sigma = results.find("median_sigma");
  if (sigma == results.end() || !sigma->is_object()) return;
  const auto combined = sigma->find("combined_mm");
  if (combined != sigma->end() && combined->is_number()) row.sigma_mm = combined->get<double>();
}

nlohmann::ordered_json json_of(const BatchRow& row) {
  constexpr const char* kStates[] = {"open", "done", "failed"};  // NOLINT(*-avoid-c-arrays)
  return {{"name", row.name},
          {"state", kStates[static_cast<int>(row.state)]},
          {"exit_code", row.exit_code},
          {"message", row.message},
          {"seconds", row.seconds},
          {"processor_s", row.processor_s},
          {"memory_mb", row.memory_mb},
          {"points", row.points},
          {"triangles", row.triangles},
          {"sigma_mm", std::isnan(row.sigma_mm) ? Json() : Json(row.sigma_mm)}};
}

BatchRow row_of(const nlohmann::ordered_json& json) {
  BatchRow row;
  row.name = json.value("name", "");
  const std::string state = json.value("state", "open");
  row.state = state == "done"     ? BatchState::Done
              : state == "failed" ? BatchState::Failed
                                  : BatchState::Open;
  take_count(json, "exit_code", row.exit_code);
  row.message = json.value("message", "");
  row.seconds = json.value("seconds", 0.0);
  row.processor_s = json.value("processor_s", 0.0);
  row.memory_mb = json.value("memory_mb", 0.0);
  take_count(json, "points", row.points);
  take_count(json, "triangles", row.triangles);
  const auto sigma = json.find("sigma_mm");
  row.sigma_mm = sigma != json.end() && sigma->is_number() ? sigma->get<double>() : std::nan("");
  return row;
}

nlohmann::ordered_json json_of(const std::vector<BatchRow>& rows) {
  Json json = Json::array();
  for (const BatchRow& row : rows)
    json.push_back(json_of(row));
  return json;
}

}  // namespace frangia
