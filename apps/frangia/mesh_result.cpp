#include "mesh_result.h"

#include <nlohmann/json.hpp>
#include <sys/resource.h>

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
