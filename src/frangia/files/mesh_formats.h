#pragma once

#include <filesystem>
#include <string>

#include "frangia/core/run.h"
#include "frangia/files/read_mesh.h"
#include "frangia/files/write_mesh.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Reader and writer of one file format.
struct MeshFormat {
  std::string extension;  ///< lower case, with its dot
  /// Reads a file of this format.
  Mesh (*read)(const std::filesystem::path&, const ReadOptions&, const Run&);
  /// Writes a file of this format.
  void (*write)(const std::filesystem::path&, const Mesh&, const WriteOptions&, const Run&);
};

/// The format of a file by its extension, upper or lower case; nullptr for an unknown extension.
[[nodiscard]] const MeshFormat* find_mesh_format(const std::filesystem::path& path);

/// All known extensions for a message: ".dxf, .stl, ... or .pcd".
[[nodiscard]] std::string mesh_extensions();

}  // namespace frangia
