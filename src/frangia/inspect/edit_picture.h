#pragma once

#include "frangia/core/run.h"
#include "frangia/inspect/shade_mesh.h"
#include "frangia/mesh/edit_operation.h"
#include "frangia/mesh/edit_preview.h"

namespace frangia {

/// What an edit would do: the mesh before it, where it would take or move something in violet;
/// beside it the mesh after it, marks in their colours, what is selected in violet. Both are seen
/// from where most of what changes, or is selected, faces.
///
/// missing  an empty mesh after the edit is left out
/// errors   Error(Input) as shade_mesh for the mesh before
[[nodiscard]] Image<Rgb> edit_picture(const Mesh& before,
                                      const EditState& after,
                                      const EditPreview& preview,
                                      ShadeOptions options = {},
                                      const Run& run = {});

}  // namespace frangia
