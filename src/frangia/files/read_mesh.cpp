#include "frangia/files/read_mesh.h"

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/files/ending_of.h"
#include "frangia/files/obj.h"
#include "frangia/files/ply.h"
#include "frangia/files/stl.h"

namespace frangia {

Mesh read_mesh(const std::filesystem::path& path) {
  const std::string ending = ending_of(path);
  if (ending == ".stl") return read_stl(path);
  if (ending == ".ply") return read_ply(path);
  if (ending == ".obj") return read_obj(path);
  throw Error(
      ErrorKind::Input,
      fmt::format("{}: a mesh is read from .stl, .ply or .obj; name such a file", path.string()));
}

}  // namespace frangia
