// Fuzzes the reader that FRANGIA_FUZZ_ENDING selects: ".ply", ".dxf", ... or ".json" for edit
// scripts. A reader must throw an Error or return a consistent mesh; anything else is a crash.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <sys/mman.h>
#include <unistd.h>

#include "frangia/core/error.h"
#include "frangia/editor/edit_script.h"
#include "frangia/files/internal/check_mesh.h"
#include "frangia/files/mesh_formats.h"

namespace {

std::string extension() {
  const char* const named = std::getenv("FRANGIA_FUZZ_ENDING");
  return named == nullptr ? ".ply" : named;
}

void read(const std::filesystem::path& path) {
  static const std::string kEnding = extension();
  if (kEnding == ".json") {
    static_cast<void>(frangia::read_edit_script(path));
    return;
  }
  const frangia::MeshFormat* const format = frangia::find_mesh_format("mesh" + kEnding);
  if (format == nullptr) std::abort();
  frangia::check_mesh(format->read(path, {}), path);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const int file = ::memfd_create("fuzz", 0);
  if (file < 0 || ::write(file, data, size) != static_cast<ssize_t>(size)) std::abort();
  try {
    read("/proc/self/fd/" + std::to_string(file));
  } catch (const frangia::Error&) {  // the reader refused the file
  }
  ::close(file);
  return 0;
}
