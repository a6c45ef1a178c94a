#pragma once

#include <filesystem>

#include "frangia/files/dxf.h"
#include "frangia/surface/mesh.h"

namespace frangia {

struct WriteOptions {
  DxfOptions dxf;
};

/// Writes .dxf, .stl, .ply or .obj, whole or not at all; the ending, in either case, says which.
///
/// units    mm
/// missing  only .ply keeps sigma_mm and views; only .ply and .obj keep normals and points without
///          triangles
/// errors   Error(Input) for another ending; else as write_dxf, write_stl, write_ply and write_obj
void write_mesh(const std::filesystem::path& path,
                const Mesh& mesh,
                const WriteOptions& options = {});

/// Throws as write_mesh would for an ending that it does not know: to ask before long work, not
/// after it.
void check_mesh_ending(const std::filesystem::path& path);

}  // namespace frangia
