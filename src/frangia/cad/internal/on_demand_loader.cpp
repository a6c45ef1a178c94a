// Stands for the functions of the library that need OpenCASCADE in programs that load it when they
// read a CAD file. The linker takes these, which come before the library, and leaves those out.
#include <filesystem>

#include <dlfcn.h>
#include <fmt/format.h>

#include "frangia/cad/internal/cad_reader.h"
#include "frangia/core/error.h"

namespace frangia {
namespace {

CadReader load_reader() {
  std::error_code failed;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", failed);
  const auto file = (program.parent_path() / kCadReaderFile).lexically_normal();
  // It stays loaded, since the faces of a model are its own.
  void* const object = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const symbol = object == nullptr ? nullptr : ::dlsym(object, kCadReaderSymbol);
  if (symbol == nullptr) {
    const char* const why = ::dlerror();  // NOLINT(concurrency-mt-unsafe) each thread has its own
    throw Error(
        ErrorKind::File,
        fmt::format("{}, which reads CAD files, cannot be loaded ({}); install frangia again",
                    file.string(),
                    why == nullptr ? "it exports nothing" : why));
  }
  return *reinterpret_cast<const CadReader* (*)()>(symbol)();
}

const CadReader& reader() {
  static const CadReader loaded = load_reader();
  return loaded;
}

}  // namespace

TranslatedCad translate_in_process(const std::filesystem::path& path,
                                   const CadRequest& asked,
                                   const ProcessLimits& limits,
                                   const Run& run) {
  return reader().translate(path, asked, limits, run);
}

std::unique_ptr<CadModel::Faces> load_faces(std::istream& shape, const Run& run) {
  return reader().load(shape, run);
}

}  // namespace frangia
