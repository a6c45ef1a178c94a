#include "frangia/files/write_mesh.h"

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/files/mesh_formats.h"

namespace frangia {

void write_mesh(const std::filesystem::path& path,
                const Mesh& mesh,
                const WriteOptions& options,
                const Run& run) {
  check_mesh_extension(path);
  find_mesh_format(path)->write(path, mesh, options, run);
}

void check_mesh_extension(const std::filesystem::path& path) {
  if (find_mesh_format(path) != nullptr) return;
  throw Error(
      ErrorKind::Input,
      fmt::format(
          "{}: unknown mesh format; use a name that ends in {}", path.string(), mesh_extensions()));
}

}  // namespace frangia
