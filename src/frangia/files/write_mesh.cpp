#include "frangia/files/write_mesh.h"

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/files/ending_of.h"
#include "frangia/files/obj.h"
#include "frangia/files/ply.h"
#include "frangia/files/stl.h"

namespace frangia {

void write_mesh(const std::filesystem::path& path, const Mesh& mesh, const WriteOptions& options) {
  check_mesh_ending(path);
  const std::string ending = ending_of(path);
  if (ending == ".dxf") write_dxf(path, mesh, options.dxf);
  if (ending == ".stl") write_stl(path, mesh);
  if (ending == ".ply") write_ply(path, mesh);
  if (ending == ".obj") write_obj(path, mesh);
}

void check_mesh_ending(const std::filesystem::path& path) {
  const std::string ending = ending_of(path);
  if (ending == ".dxf" || ending == ".stl" || ending == ".ply" || ending == ".obj") return;
  throw Error(ErrorKind::Input,
              fmt::format("{}: a mesh is written as .dxf, .stl, .ply or .obj; name such a file",
                          path.string()));
}

}  // namespace frangia
