#pragma once

#include <cstdint>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/selection.h"

namespace frangia {

/// Size of one connected component of a mesh.
struct MeshComponent {
  std::size_t triangles = 0;  ///< number of triangles
  double area_mm2 = 0.0;      ///< total area of the triangles
  double size_mm = 0.0;       ///< diagonal of the bounding box
};

/// The sets of triangles that are connected by shared vertices.
struct ConnectedComponents {
  std::vector<std::uint32_t> component_of;  ///< one for each triangle
  std::vector<MeshComponent> components;    ///< in the order of their first triangles
};

/// Finds the connected components of a mesh.
///
/// @units    mm, mm^2
[[nodiscard]] ConnectedComponents connected_components(const Mesh& mesh);

/// Selects the component that a triangle belongs to.
///
/// @errors   Error(Input) when the triangle does not exist
[[nodiscard]] Selection select_component(const Mesh& mesh, std::size_t triangle);

/// Keeps the `count` components of the largest area.
///
/// @errors   Error(Input) when `count` is 0
[[nodiscard]] Mesh keep_largest_components(Mesh mesh, std::size_t count = 1);

/// Removes the components whose bounding box has at most this diagonal. The component of the
/// largest area always stays; where it is no larger, `run` receives a warning. A note counts what
/// is removed.
[[nodiscard]] Mesh remove_islands(Mesh mesh, double up_to_mm, const Run& run = {});

/// Gives shells that touch each other, in an edge or in a vertex, vertices of their own there, as
/// for meshes whose vertices were joined by their place. The sides of an edge of more than two
/// triangles that have no partner (`pair_sides`) stay together. No vertex moves, and no triangle is
/// removed.
///
/// @errors   as HalfEdges
[[nodiscard]] Mesh separate_shells(Mesh mesh);

}  // namespace frangia
