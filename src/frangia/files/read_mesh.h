#pragma once

#include <filesystem>

#include "frangia/core/run.h"
#include "frangia/files/read_options.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Reads a mesh; the extension selects the format (mesh_formats.h). Where faces have vertices of
/// their own, as exporters of flat-shaded parts write them, the vertices are joined where edges
/// meet, with a warning; closed bodies that touch and seams between values of vertices stay apart.
///
/// @units    mm: converted where the file states its unit, otherwise assumed
/// @missing  the reader reports what it skips through `run`
/// @errors   Error(Input) for an unknown extension, and for a file that would take more memory than
///          `options` allow, with the size that it needs; otherwise as the reader of the format
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& path,
                             const Run& run = {},
                             const ReadOptions& options = {});

}  // namespace frangia
