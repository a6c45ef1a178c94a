#pragma once

#include <filesystem>

#include "frangia/core/run.h"
#include "frangia/files/read_options.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Reads a mesh that must have triangles.
///
/// @units    mm, as read_mesh
/// @errors   Error(Input) as read_mesh, and when the file holds points alone
[[nodiscard]] Mesh read_surface(const std::filesystem::path& path,
                                const Run& run = {},
                                const ReadOptions& options = {});

}  // namespace frangia
