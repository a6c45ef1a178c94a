#include "mesh_result.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "counted.h"
#include "print_text.h"

namespace frangia {
namespace {

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

}  // namespace

void print_mesh_result(nlohmann::ordered_json result,
                       const std::string& untrusted_reason,
                       Terminal& terminal,
                       const std::vector<std::filesystem::path>& outputs) {
  result["trustworthy"] = untrusted_reason.empty();
  if (!untrusted_reason.empty()) result["reason"] = untrusted_reason;
  for (const auto& [stage, seconds] : terminal.stage_seconds())
    result["seconds"][stage] = seconds;
  result["peak_memory_mb"] = peak_memory_mb();
  result["warnings"] = terminal.warnings();
  for (const auto& path : outputs)
    result["outputs"].push_back(path.string());
  print_json(result);
}

nlohmann::ordered_json json_of(const RemovedIslands& removed) {
  return {{"count", removed.count},
          {"triangles", removed.triangles},
          {"largest_mm", removed.largest_mm}};
}

std::string text_of(const RemovedIslands& removed) {
  if (removed.count == 0) return {};
  return fmt::format(
      ", {} of at most {:.3g} mm removed", counted(removed.count, "island"), removed.largest_mm);
}

void print_mesh_summary(Terminal& terminal, const std::vector<std::filesystem::path>& outputs) {
  if (terminal.verbose) {
    for (const auto& [stage, seconds] : terminal.stage_seconds())
      print_text("  {:<10}{:7.2f} s\n", stage, seconds);
    print_text("  {:<10}{:7.0f} MB\n", "peak", peak_memory_mb());
  }
  for (const auto& path : outputs)
    print_text("wrote {}\n", path.string());
}

}  // namespace frangia
