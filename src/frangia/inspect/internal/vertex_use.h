#pragma once

#include <cstdint>
#include <vector>

#include "frangia/core/angles.h"
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

/// Largest angle between the normal of a vertex and those of its triangles that is no sharp edge:
/// it is 45 degrees at the edge of a box, 15 on a cylinder of 12 facets.
inline constexpr double kSharpEdge = rad_from_deg(30.0);

/// 1 for each vertex at a sharp edge: its triangles face too differently for one normal.
///
/// @shape    one normal for each vertex
[[nodiscard]] std::vector<std::uint8_t> sharp_edge_flags(
    const Mesh& mesh, const std::vector<Eigen::Vector3f>& normals, double max_rad = kSharpEdge);

/// A third of the area of the triangles of each vertex, mm2.
[[nodiscard]] std::vector<double> vertex_areas(const Mesh& mesh);

}  // namespace frangia
