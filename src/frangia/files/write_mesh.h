#pragma once

#include <filesystem>

#include "frangia/core/run.h"
#include "frangia/files/dxf.h"
#include "frangia/files/stl.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Options of the formats that have some; each format uses only its own.
struct WriteOptions {
  DxfOptions dxf;  ///< for .dxf
  StlOptions stl;  ///< for .stl
};

/// Writes a mesh; the extension selects the format (mesh_formats.h). The file appears under its
/// name when it is complete; until then an existing file of that name stays.
///
/// @units    mm; metres in glTF
/// @missing  sigma and views are kept in .ply, .glb, .gltf and .pcd; marks also in .dxf, .3mf, .obj
///          and .off (as colours); normals in .ply, .glb, .gltf, .obj, .xyz and .pcd; .xyz and .pcd
///          store no triangles. `run` is warned when the mesh does not suit the format.
/// @errors   Error(Input) for an unknown extension; otherwise as the writer of the format
void write_mesh(const std::filesystem::path& path,
                const Mesh& mesh,
                const WriteOptions& options = {},
                const Run& run = {});

/// Checks an output path before long work.
///
/// @errors   Error(Input) as write_mesh for an unknown extension
void check_mesh_extension(const std::filesystem::path& path);

}  // namespace frangia
