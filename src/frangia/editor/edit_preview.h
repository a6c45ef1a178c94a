#pragma once

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/selection.h"

namespace frangia {

/// Where a mesh and the result of an edit differ.
struct EditPreview {
  /// Triangles of the mesh before that are removed, moved or reversed.
  Selection removed;
  /// Triangles of the mesh after that are new, moved or reversed.
  Selection added;
};

/// Compares a mesh with the result of an edit. Edits are functions of a mesh, so every edit has a
/// preview:
///
///     const EditPreview preview = edit_preview(mesh, remove_islands(mesh, 2.0));
///
/// The comparison is between surfaces: a triangle that lies on the other surface within its sigma
/// and faces the same way counts as present, whatever the triangulation.
///
/// @shape    one flag per triangle of the mesh before and after
/// @errors   Error(Input) when a triangle refers to a vertex that does not exist
[[nodiscard]] EditPreview edit_preview(const Mesh& before, const Mesh& after, const Run& run = {});

}  // namespace frangia
