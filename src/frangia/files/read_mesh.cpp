#include "frangia/files/read_mesh.h"

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/files/internal/join_soup.h"
#include "frangia/files/mesh_formats.h"

namespace frangia {

Mesh read_mesh(const std::filesystem::path& path, const Run& run, const ReadOptions& options) {
  const MeshFormat* format = find_mesh_format(path);
  if (format == nullptr) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: unknown mesh format; use a file that ends in {}",
                            path.string(),
                            mesh_extensions()));
  }
  return join_soup(format->read(path, options, run), path, run);
}

}  // namespace frangia
