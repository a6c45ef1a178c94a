#pragma once

#include <filesystem>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// A PLY file, ascii or binary of either byte order. Points without faces are a mesh without
/// triangles.
///
/// shape    kept: x y z, nx ny nz when all three are there, sigma_mm, views (an ushort), mark (an
///          uchar of a vertex or face: 0 measured, 1 moved, 2 invented); faces of
///          any size become triangles. Other properties and elements are skipped.
/// units    as in the file, taken for mm
/// missing  a normal that is not finite is zero
/// errors   Error(Input) that names the file and what is wrong with it: cut short, a count that the
///          file has no room for, a face with fewer than three corners or of a vertex that is not
///          there, a vertex that is not finite, triangle strips
/// source   Greg Turk, The PLY Polygon File Format, 1994
[[nodiscard]] Mesh read_ply(const std::filesystem::path& path);

/// Binary, little endian: x y z, nx ny nz and sigma_mm when the mesh has them, all float; views, an
/// ushort, and mark, an uchar, when it has them; faces, with their mark when they have it.
///
/// units    mm
/// errors   Error(Input) when the mesh is not whole; Error(File) when it cannot be written
void write_ply(const std::filesystem::path& path, const Mesh& mesh);

}  // namespace frangia
