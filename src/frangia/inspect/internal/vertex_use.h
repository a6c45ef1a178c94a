#pragma once

#include <cstdint>
#include <vector>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// What a vertex is good for.
enum class VertexUse : std::uint8_t {
  Measured,     ///< measured, amid measured surface
  Synthesized,  ///< it, or all of its triangles, were not measured
  MeshEdge,     ///< on the boundary of the mesh, where the measurement ends
  Unused        ///< no triangle uses it, or it is not finite
};

/// The use of each vertex.
[[nodiscard]] std::vector<VertexUse> vertex_uses(const Mesh& mesh);

/// 1 for each vertex that an edge with a single triangle uses, 0 for the others.
[[nodiscard]] std::vector<std::uint8_t> boundary_flags(const Mesh& mesh);

/// A third of the area of the triangles of each vertex, mm2.
[[nodiscard]] std::vector<double> vertex_areas(const Mesh& mesh);

}  // namespace frangia
