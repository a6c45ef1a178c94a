#pragma once

#include <filesystem>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Reads an STL file. Its size decides whether it is binary or ascii. Bytes behind the last facet
/// are left out with a warning, and a count of 0 or -1 of a program that streams is passed over
/// with one.
///
/// @shape    corners with identical coordinates become one vertex; the normals in the file are
///          ignored
/// @units    as in the file, assumed to be mm
/// @missing  a triangle with two identical corners is omitted
/// @errors   Error(Input) that names the file and the fault: truncated, a count that does not match
///          the size, a coordinate that is not finite
/// @source   3D Systems, Stereolithography Interface Specification, 1989
[[nodiscard]] Mesh read_stl(const std::filesystem::path& path, const Run& run = {});

/// Options of `write_stl`.
struct StlOptions {
  bool ascii = false;  ///< text instead of binary; about five times as large
};

/// Writes an STL file with one normal per triangle. Text has the shortest digits that read back to
/// the same number.
///
/// @units    mm
/// @missing  vertex normals, sigma, views and marks are not stored
/// @errors   Error(Input) when check_mesh fails or the mesh has no triangle; Error(File) when the
///          file cannot be written
void write_stl(const std::filesystem::path& path, const Mesh& mesh, const StlOptions& options = {});

}  // namespace frangia
