#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// A selection of triangles: one flag, 0 or 1, for each triangle of a mesh.
using Selection = std::vector<std::uint8_t>;

/// Returns the number of selected triangles.
[[nodiscard]] inline std::size_t count_selected(const Selection& selection) {
  std::size_t count = 0;
  for (const std::uint8_t flag : selection)
    count += flag;
  return count;
}

/// Adds the triangles that share a vertex with a selected one, `rings` times.
///
/// @errors   Error(Input) when the selection has not one flag for each triangle
[[nodiscard]] Selection grow_selection(const Mesh& mesh, Selection selection, int rings = 1);

/// Removes the triangles that share a vertex with an unselected one, `rings` times.
///
/// @errors   as grow_selection
[[nodiscard]] Selection shrink_selection(const Mesh& mesh, Selection selection, int rings = 1);

/// Inverts every flag.
[[nodiscard]] Selection invert_selection(Selection selection);

/// Returns the mesh without the selected triangles and the vertices that only they used.
///
/// @errors   Error(Input) when the selection has not one flag for each triangle
[[nodiscard]] Mesh delete_selected(Mesh mesh, const Selection& selection);

}  // namespace frangia
