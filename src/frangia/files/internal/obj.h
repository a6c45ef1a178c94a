#pragma once

#include <filesystem>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Reads a Wavefront OBJ file: v, vn and f with corners as a, a/b, a//c or a/b/c, including
/// negative (relative) indices. Triangles of groups named displaced and synthesized get that mark.
/// Other lines are skipped.
///
/// @shape    polygons are triangulated in their mean plane; normals are read only when every corner
///          uses the normal with the index of its vertex, since an OBJ may give one vertex several
/// @units    as in the file, assumed to be mm
/// @errors   Error(Input) that names the file and the line or triangle: an invalid number, a face
///          with fewer than three corners, a vertex index out of range, a coordinate that is not
///          finite
/// @source   Wavefront, Advanced Visualizer manual, appendix B1
[[nodiscard]] Mesh read_obj(const std::filesystem::path& path, const Run& run = {});

/// Writes vertices, normals and faces with the shortest digits that read back to the same numbers.
/// A mesh with marks has its triangles in groups named measured, displaced and synthesized.
///
/// @units    mm
/// @missing  sigma and views are not stored
/// @errors   Error(Input) when check_mesh fails; Error(File) when the file cannot be written
void write_obj(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace frangia
