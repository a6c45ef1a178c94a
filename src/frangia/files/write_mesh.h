#pragma once

#include <filesystem>

#include "frangia/files/dxf.h"
#include "frangia/files/stl.h"
#include "frangia/surface/mesh.h"

namespace frangia {

struct WriteOptions {
  DxfOptions dxf;
  StlOptions stl;
};

/// Writes a mesh, whole or not at all; the ending, in either case, says which of mesh_formats.h.
///
/// units    mm; glTF in m
/// missing  .ply, .glb and .gltf keep sigma_mm, views and marks; .obj, .xyz and .pcd normals too;
///          .dxf, .3mf, .obj and .off keep marks alone; .xyz and .pcd keep no triangles
/// errors   Error(Input) for another ending; else as the format's own writer
void write_mesh(const std::filesystem::path& path,
                const Mesh& mesh,
                const WriteOptions& options = {});

/// Throws as write_mesh would for an ending that it does not know: to ask before long work, not
/// after it.
void check_mesh_ending(const std::filesystem::path& path);

}  // namespace frangia
