#pragma once

namespace frangia {

/// Memory that a mesh takes while it is read and edited, bytes: the mesh itself, its adjacency and
/// its box tree: estimates from the sizes of these structures, not measured.
[[nodiscard]] inline double mesh_memory_bytes(double vertices, double triangles) {
  constexpr double kPerVertex = 100.0;
  constexpr double kPerTriangle = 200.0;
  return kPerVertex * vertices + kPerTriangle * triangles;
}

}  // namespace frangia
