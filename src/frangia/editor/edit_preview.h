#pragma once

#include "frangia/core/run.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/selection.h"

namespace frangia {

/// Where a mesh and what an edit makes of it differ.
struct EditPreview {
  Selection
      removed;      ///< of the mesh before: triangles that are gone, or elsewhere, or turned round
  Selection added;  ///< of the mesh after: triangles that were not there, or not like this
};

/// What an edit would do, to be looked at before it is done. Edits are functions of a mesh, so any
/// of them has its preview:
///
///     const EditPreview preview = edit_preview(mesh, remove_islands(mesh, 2.0));
///
/// Surfaces are compared, not triangles: a triangle that lies on the other surface within its
/// sigma, and faces the same way, is still there, however that surface is cut into triangles.
/// errors   Error(Input) when a triangle refers to a vertex that is not there
[[nodiscard]] EditPreview edit_preview(const Mesh& before, const Mesh& after, const Run& run = {});

}  // namespace frangia
