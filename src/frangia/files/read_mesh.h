#pragma once

#include <filesystem>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Reads a mesh; the extension selects the format (mesh_formats.h).
///
/// @units    mm: converted where the file states its unit, otherwise assumed
/// @missing  the reader reports what it skips through `run`
/// @errors   Error(Input) for an unknown extension; otherwise as the reader of the format
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& path, const Run& run = {});

}  // namespace frangia
