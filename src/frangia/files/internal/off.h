#pragma once

#include <filesystem>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Reads a text OFF file: OFF, COFF, NOFF, STOFF and their combinations.
///
/// @shape    polygons are triangulated in their mean plane; colours, normals and texture
/// coordinates are skipped
/// @units    as in the file, assumed to be mm
/// @errors   Error(Input) that names the file and the line: counts larger than the file can hold, a
///          face with fewer than three corners, a vertex index out of range, a coordinate that is
///          not finite, a binary OFF
/// @source   Geomview manual, OFF Files
[[nodiscard]] Mesh read_off(const std::filesystem::path& path, const Run& run = {});

/// Writes vertices and faces with the shortest digits that read back to the same numbers. Displaced
/// triangles are yellow, synthesized ones blue.
///
/// @units    mm
/// @missing  normals, sigma and views are not stored
/// @errors   Error(Input) when check_mesh fails or the mesh has no triangle; Error(File) when the
///          file cannot be written
void write_off(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace frangia
