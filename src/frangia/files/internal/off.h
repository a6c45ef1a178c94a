#pragma once

#include <filesystem>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// An OFF file, text: OFF, COFF, NOFF and their like.
///
/// shape    polygons become fans of triangles; colours, normals and texture places are skipped
/// units    as in the file, taken for mm
/// errors   Error(Input) that names the file and the line: counts that the file has no room for, a
///          face with fewer than three corners or of a vertex that is not there, a vertex that is
///          not finite, the binary form
/// source   Geomview manual, OFF Files
[[nodiscard]] Mesh read_off(const std::filesystem::path& path);

/// The shortest digits that read back as the same numbers. Triangles that were moved are yellow,
/// invented ones red.
///
/// units    mm
/// missing  normals, sigma_mm and views have no place
/// errors   Error(Input) when the mesh is not whole or has no triangle; Error(File) when it cannot
///          be written
void write_off(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace frangia
