// mesh_counts: reads the files that standard input names, a line each, and answers with a line of
// JSON each: triangles and points that were read, warnings, or the sentence of a refusal. For
// tests/files/mutated_counts_test.py, which compares the counts with what the files state.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <string>

#include <nlohmann/json.hpp>

#include "frangia/core/error.h"
#include "frangia/files/read_mesh.h"

#ifdef FRANGIA_WITH_EXCHANGE
#include "frangia/exchange/read_calibration_file.h"
#endif

namespace {

/// Whether a file is a calibration of another program; reads it.
bool read_as_calibration([[maybe_unused]] const std::filesystem::path& path,
                         [[maybe_unused]] const frangia::Run& run) {
#ifdef FRANGIA_WITH_EXCHANGE
  for (const char* ending : {".yml", ".yaml", ".xml", ".mat", ".json", ".txt"}) {
    if (path.extension() != ending) continue;
    static_cast<void>(frangia::read_calibration_files({&path, 1}, run));
    return true;
  }
#endif
  return false;
}

nlohmann::json answer_of(const std::filesystem::path& path) {
  nlohmann::json answer{{"warnings", 0}};
  frangia::Run run;
  std::size_t warnings = 0;
  run.on_warning = [&](const std::string&) { ++warnings; };
  try {
    if (!read_as_calibration(path, run)) {
      const frangia::Mesh mesh = frangia::read_mesh(path, run);
      answer["triangles"] = mesh.triangles.size();
      answer["points"] = mesh.vertices_mm.size();
    }
  } catch (const frangia::Error& error) {
    answer["error"] = error.what();
  }
  answer["warnings"] = warnings;
  return answer;
}

}  // namespace

int main() {
  for (std::string name; std::getline(std::cin, name);) {
    constexpr int kCompact = -1;
    std::cout << answer_of(name).dump(kCompact, ' ', true, nlohmann::json::error_handler_t::replace)
              << std::endl;  // each answer at once: the next file may end the program
  }
  return 0;
}
