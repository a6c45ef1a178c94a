#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Checks the consistency of a mesh after reading or before writing.
///
/// @errors   Error(Input) that names the file and the element: a vertex or normal that is not
///          finite, a vertex farther than 1e15 mm from the origin, a triangle with a vertex index
///          out of range, or normals, sigma, views or marks whose number differs from that of the
///          vertices or triangles
void check_mesh(const Mesh& mesh, const std::filesystem::path& path);

/// As check_mesh, for a format that cannot store points alone.
///
/// @errors   Error(Input) also when the mesh has no triangle
void check_triangles(const Mesh& mesh, const std::filesystem::path& path);

/// Memory that a mesh takes while it is read and edited, bytes: the mesh itself, its adjacency and
/// its box tree: estimates from the sizes of these structures, not measured.
[[nodiscard]] inline double mesh_memory_bytes(double vertices, double triangles) {
  constexpr double kPerVertex = 100.0;
  constexpr double kPerTriangle = 200.0;
  return kPerVertex * vertices + kPerTriangle * triangles;
}

/// What a file is that begins with these bytes and that no reader of meshes takes whatever its
/// name, and what to do: "it is compressed by gzip; unpack it with gunzip". Empty for other bytes.
[[nodiscard]] std::string other_kind_of(std::string_view head);

/// As above, for the file; empty also where it cannot be read.
[[nodiscard]] std::string other_kind_of_file(const std::filesystem::path& path);

/// Warns of data behind what the header of a file counts; blanks and zeros do not matter.
inline void warn_of_rest(std::string_view rest, const std::filesystem::path& path, const Run& run) {
  constexpr std::string_view kBlank(" \t\r\n\v\f\0\x1A", 8);
  if (rest.find_first_not_of(kBlank) == std::string_view::npos) return;
  run.warn(
      fmt::format("{}: {} byte{} left out behind what its header counts; the header may be wrong",
                  path.string(),
                  rest.size(),
                  rest.size() == 1 ? " is" : "s are"));
}

}  // namespace frangia
