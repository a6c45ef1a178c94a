#pragma once

#include <cstddef>
#include <string>

#include "frangia/files/write_mesh.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Estimates the size of an exported file from two samples of the mesh that are written to the
/// folder of temporary files: within a tenth for a mesh of even resolution.
///
/// @units    bytes
/// @errors   Error(Input) for an unknown format or a mesh without triangles; Error(File)
[[nodiscard]] std::size_t export_size(const Mesh& mesh,
                                      const std::string& format,
                                      std::size_t triangles,
                                      const WriteOptions& options);

}  // namespace frangia
