#pragma once

#include <filesystem>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// An STL file, binary or ascii: its size says which.
///
/// shape    corners at the same place become one vertex; the file's normals are not kept
/// units    as in the file, taken for mm
/// missing  a triangle with two corners at one place is left out
/// errors   Error(Input) that names the file and what is wrong with it: cut short, a count that
///          does not fit its size, a corner that is not finite
/// source   3D Systems, Stereolithography Interface Specification, 1989
[[nodiscard]] Mesh read_stl(const std::filesystem::path& path);

struct StlOptions {
  bool ascii = false;  ///< as text: five times as large, but anyone can read it
};

/// Each triangle with its own normal; binary, or text with the shortest digits that read back as
/// the same numbers.
///
/// units    mm
/// missing  normals of vertices, sigma_mm, views and marks have no place
/// errors   Error(Input) when the mesh is not whole or has no triangle; Error(File) when it cannot
///          be written
void write_stl(const std::filesystem::path& path, const Mesh& mesh, const StlOptions& options = {});

}  // namespace frangia
