#include "batch/batch_table.h"

#include <cmath>

#include <fmt/format.h>

#include "frangia/core/durable_file.h"

#include "terminal_text.h"
#include "text_table.h"

namespace frangia {
namespace {

const char* name_of(const BatchRow& row) {
  switch (row.state) {
    case BatchState::Open:
      return "open";
    case BatchState::Done:
      return "done";
    case BatchState::Failed:
      break;
  }
  return "failed";
}

std::string sigma_of(const BatchRow& row) {
  return std::isnan(row.sigma_mm) ? "-" : fmt::format("{:.4g}", row.sigma_mm);
}

/// A field of CSV (RFC 4180).
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

}  // namespace

std::string table_of(const std::vector<BatchRow>& rows) {
  TextColumn name{"scan", {}, false};
  TextColumn state{"state", {}, false};
  TextColumn points{"points", {}};
  TextColumn triangles{"triangles", {}};
  TextColumn sigma{"sigma mm", {}};
  TextColumn seconds{"seconds", {}};
  TextColumn memory{"MB", {}};
  TextColumn message{"", {}, false};
  for (const BatchRow& row : rows) {
    name.values.push_back(terminal_text(row.name));
    state.values.emplace_back(name_of(row));
    points.values.push_back(std::to_string(row.points));
    triangles.values.push_back(std::to_string(row.triangles));
    sigma.values.push_back(sigma_of(row));
    seconds.values.push_back(fmt::format("{:.1f}", row.seconds));
    memory.values.push_back(fmt::format("{:.0f}", row.memory_mb));
    message.values.push_back(terminal_text(row.message));
  }
  return text_table({name, state, points, triangles, sigma, seconds, memory, message});
}

void write_table(const std::vector<BatchRow>& rows, const std::filesystem::path& out) {
  AtomicFile csv(out / "table.csv");
  csv.stream() << "name,state,exit_code,points,triangles,sigma_mm,seconds,processor_s,memory_mb,"
                  "message\n";
  for (const BatchRow& row : rows) {
    csv.stream() << fmt::format("{},{},{},{},{},{},{:.3f},{:.3f},{:.1f},{}\n",
                                field(row.name),
                                name_of(row),
                                row.exit_code,
                                row.points,
                                row.triangles,
                                std::isnan(row.sigma_mm) ? "" : fmt::format("{}", row.sigma_mm),
                                row.seconds,
                                row.processor_s,
                                row.memory_mb,
                                field(row.message));
  }
  csv.commit();
  AtomicFile json(out / "table.json");
  json.stream() << json_of(rows).dump(
                       2, ' ', true, nlohmann::ordered_json::error_handler_t::replace)
                << '\n';
  json.commit();
}

}  // namespace frangia
