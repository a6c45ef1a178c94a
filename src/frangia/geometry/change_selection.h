#pragma once

#include "frangia/geometry/mesh.h"
#include "frangia/geometry/selection.h"

namespace frangia {

/// Adds the triangles that share a vertex with a selected one, `rings` times.
[[nodiscard]] Selection grow_selection(const Mesh& mesh, Selection selection, int rings = 1);

/// Takes away the triangles that share a vertex with one that is not selected, `rings` times.
[[nodiscard]] Selection shrink_selection(const Mesh& mesh, Selection selection, int rings = 1);

[[nodiscard]] Selection invert_selection(Selection selection);

/// The mesh without its selected triangles, and without the vertices that only they used.
///
/// errors   Error(Input) when there is not one flag a triangle
[[nodiscard]] Mesh delete_selected(Mesh mesh, const Selection& selection);

}  // namespace frangia
