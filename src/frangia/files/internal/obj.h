#pragma once

#include <filesystem>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// A Wavefront OBJ file: v, vn and f, with corners written a, a/b, a//c or a/b/c, also counted back
/// from the end. Groups named displaced and synthesized mark their triangles. Everything else is skipped.
///
/// shape    polygons become fans of triangles. Normals are kept when there is one a vertex, in the
///          vertices' order, and dropped otherwise (an OBJ may give one vertex many).
/// units    as in the file, taken for mm
/// errors   Error(Input) that names the file and the line or triangle: a number that is none, a
///          face with fewer than three corners or of a vertex that is not there, a vertex that is
///          not finite
/// source   Wavefront, Advanced Visualizer manual, appendix B1
[[nodiscard]] Mesh read_obj(const std::filesystem::path& path);

/// The shortest digits that read back as the same numbers; normals when the mesh has them;
/// triangles in groups named measured, displaced and synthesized when it has marks.
///
/// units    mm
/// missing  sigma_mm and views have no place in an OBJ
/// errors   Error(Input) when the mesh is not whole; Error(File) when it cannot be written
void write_obj(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace frangia
