#pragma once

#include <filesystem>

#include "frangia/surface/mesh.h"

namespace frangia {

/// The mesh of a .stl, .ply or .obj file; the ending, in either case, says which.
///
/// units    as in the file, taken for mm
/// errors   Error(Input) for another ending; else as read_stl, read_ply and read_obj
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& path);

}  // namespace frangia
