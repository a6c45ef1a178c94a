#pragma once

#include <filesystem>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// A glTF 2.0 file, .glb or .gltf with its buffers inside it or beside it: the triangles of the
/// scene, each placed by its nodes.
///
/// shape    normals are kept when every part has them, and _SIGMA_MM, _VIEWS and _MARK, which
///          write_gltf writes; marks of triangles come back from the names of its materials
/// units    m with y up become mm with z up
/// missing  points, lines, skins and morphs are left out; `run` is warned of what was
/// errors   Error(Input) that names the file and what is wrong with it: JSON that is none, lengths
///          and counts that the file has no room for, a vertex that is not there, a node that is
///          its own child, buffers elsewhere, sparse or compressed data, triangle strips
/// source   Khronos Group, glTF 2.0 specification
[[nodiscard]] Mesh read_gltf(const std::filesystem::path& path, const Run& run = {});

/// One node with the mesh; .glb binary, .gltf as text with the buffer inside. Triangles are parted
/// by mark into materials "measured", "displaced" (yellow) and "synthesized" (red).
///
/// units    m: coordinates are kept in mm, and the node scales them and turns z up to y up
/// missing  nothing: _SIGMA_MM, _VIEWS and _MARK are attributes of vertices
/// errors   Error(Input) when the mesh is not whole, has no triangle, or is larger than the 4 GB
///          that the format holds; Error(File) when it cannot be written
void write_gltf(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace frangia
