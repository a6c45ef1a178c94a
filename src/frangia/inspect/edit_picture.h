#pragma once

#include "frangia/core/run.h"
#include "frangia/editor/edit_operation.h"
#include "frangia/editor/edit_preview.h"
#include "frangia/inspect/render_mesh.h"

namespace frangia {

/// What an edit would do: the mesh before it, where it would take or move something in violet;
/// beside it the mesh after it, marks in their colours, what is selected in violet. Both are seen
/// from where most of what changes, or is selected, faces.
///
/// missing  an empty mesh after the edit is left out
/// errors   Error(Input) as render_mesh for the mesh before
[[nodiscard]] Image<Rgb> edit_picture(const Mesh& before,
                                      const EditState& after,
                                      const EditPreview& preview,
                                      RenderOptions options = {},
                                      const Run& run = {});

}  // namespace frangia
