#pragma once

#include <filesystem>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// The mesh of a file; the extension, in either case, says which of mesh_formats.h it is.
///
/// units    mm: formats that state others are turned, the rest are taken for mm
/// missing  what a reader leaves out it tells to `run`
/// errors   Error(Input) for another extension; else as the format's own reader
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& path, const Run& run = {});

}  // namespace frangia
