#pragma once

#include <filesystem>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/run.h"
#include "frangia/files/read_mesh.h"

#include "counted.h"

namespace frangia {

/// Reads a mesh that must have triangles.
///
/// @errors   Error(Input) as read_mesh, and when the file holds points alone
inline Mesh read_surface(const std::filesystem::path& path,
                         const Run& run = {},
                         const ReadOptions& options = {}) {
  Mesh mesh = read_mesh(path, run, options);
  if (mesh.triangles.empty()) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: it has {} and no triangles; name a mesh with a surface",
                            path.string(),
                            counted(mesh.vertices_mm.size(), "point")));
  }
  return mesh;
}

}  // namespace frangia
