#include "frangia/files/read_surface.h"

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/files/read_mesh.h"

namespace frangia {

Mesh read_surface(const std::filesystem::path& path, const Run& run, const ReadOptions& options) {
  Mesh mesh = read_mesh(path, run, options);
  if (mesh.triangles.empty()) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: it has {} point{} and no triangles; name a mesh with a surface",
                            path.string(),
                            mesh.vertices_mm.size(),
                            mesh.vertices_mm.size() == 1 ? "" : "s"));
  }
  return mesh;
}

}  // namespace frangia
