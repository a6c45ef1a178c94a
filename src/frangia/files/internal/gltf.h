#pragma once

#include <filesystem>

#include "frangia/core/run.h"
#include "frangia/files/read_mesh.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Reads the triangles of a glTF 2.0 scene, each transformed by its nodes: a .glb, or a .gltf with
/// its buffers embedded or in files of the same folder or below.
///
/// @shape    normals are read when every primitive has them, and the attributes _SIGMA_MM, _VIEWS
///          and _MARK that write_gltf writes; marks of triangles follow from the names of materials
/// @units    metres with y up are converted to mm with z up
/// @missing  points, lines, skins and morph targets are skipped with a warning through `run`
/// @errors   Error(Input) that names the file and the fault: invalid JSON, lengths and counts
///          larger than the file, a vertex index out of range, a cycle of nodes, a buffer
///          elsewhere, compressed data, a required extension that is not known, parts that repeat
///          beyond the allowed memory
/// @source   Khronos Group, glTF 2.0 specification
[[nodiscard]] Mesh read_gltf(const std::filesystem::path& path,
                             const ReadOptions& options = {},
                             const Run& run = {});

/// Writes one node with the mesh: .glb in binary, .gltf as JSON with the buffer embedded. There is
/// one primitive per mark, with material "measured", "displaced" (yellow) or "synthesized" (blue).
///
/// @units    coordinates are stored in mm; the node scales them to metres and turns z up to y up
/// @missing  nothing: _SIGMA_MM, _VIEWS and _MARK are attributes of vertices
/// @errors   Error(Input) when check_mesh fails, when the mesh has no triangle, or when it exceeds
///          the 4 GB of the format; Error(File) when the file cannot be written
void write_gltf(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace frangia
