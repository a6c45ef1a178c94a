#pragma once

#include <filesystem>
#include <string>

#include "frangia/core/run.h"
#include "frangia/files/write_mesh.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// A file format by its extension.
struct MeshFormat {
  std::string extension;  ///< lower case, with its point
  Mesh (*read)(const std::filesystem::path&, const Run&);
  void (*write)(const std::filesystem::path&, const Mesh&, const WriteOptions&);
};

/// The format that a file's extension names, in either case; nullptr for one that is not known.
[[nodiscard]] const MeshFormat* find_mesh_format(const std::filesystem::path& path);

/// ".dxf, .stl, ... or .pcd": all endings, as a sentence has them.
[[nodiscard]] std::string mesh_extensions();

}  // namespace frangia
