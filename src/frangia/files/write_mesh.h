#pragma once

#include <filesystem>

#include "frangia/files/dxf.h"
#include "frangia/files/stl.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

struct WriteOptions {
  DxfOptions dxf;
  StlOptions stl;
};

/// Writes a mesh, whole or not at all; the extension, in either case, says which of mesh_formats.h.
///
/// units    mm; glTF in m
/// missing  .ply, .glb and .gltf keep sigma_mm, views and marks; .obj, .xyz and .pcd normals too;
///          .dxf, .3mf, .obj and .off keep marks alone; .xyz and .pcd keep no triangles
/// errors   Error(Input) for another extension; else as the format's own writer
void write_mesh(const std::filesystem::path& path,
                const Mesh& mesh,
                const WriteOptions& options = {});

/// Throws as write_mesh would for an extension that it does not know: to ask before long work, not
/// after it.
void check_mesh_extension(const std::filesystem::path& path);

}  // namespace frangia
