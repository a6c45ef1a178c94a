#pragma once

#include <cstdint>
#include <filesystem>

#include "frangia/core/memory_budget.h"
#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Options of the readers of meshes and range scans.
struct ReadOptions {
  /// Memory that a file may take, whatever its size; bytes. Files above 10 MB may take 200 times
  /// their size.
  std::uint64_t allow_memory_bytes = kAllowMemoryBytes;
};

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

/// Reads a mesh that must have triangles.
///
/// @units    mm, as read_mesh
/// @errors   Error(Input) as read_mesh, and when the file holds points alone
[[nodiscard]] Mesh read_surface(const std::filesystem::path& path,
                                const Run& run = {},
                                const ReadOptions& options = {});

}  // namespace frangia
