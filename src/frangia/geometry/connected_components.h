#pragma once

#include <cstdint>
#include <vector>

#include "frangia/geometry/mesh.h"
#include "frangia/geometry/selection.h"

namespace frangia {

struct MeshComponent {
  std::size_t triangles = 0;
  double area_mm2 = 0.0;
  double size_mm = 0.0;  ///< the diagonal of the box around it
};

/// Triangles that hang together by their vertices.
struct ConnectedComponents {
  std::vector<std::uint32_t> component_of;  ///< one a triangle
  std::vector<MeshComponent> components;    ///< in the order of their first triangle
};

[[nodiscard]] ConnectedComponents connected_components(const Mesh& mesh);

/// The part that a triangle belongs to.
///
/// errors   Error(Input) when there is no such triangle
[[nodiscard]] Selection select_component(const Mesh& mesh, std::size_t triangle);

/// The `count` parts of the largest area.
[[nodiscard]] Mesh keep_largest_components(Mesh mesh, std::size_t count = 1);

/// The mesh without the parts that fit into a box of this diagonal; the largest stays in any case.
[[nodiscard]] Mesh remove_islands(Mesh mesh, double up_to_mm);

}  // namespace frangia
