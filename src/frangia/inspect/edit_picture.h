#pragma once

#include "frangia/core/run.h"
#include "frangia/editor/edit_operation.h"
#include "frangia/editor/edit_preview.h"
#include "frangia/inspect/render_mesh.h"

namespace frangia {

/// Shows the effect of an edit: on the left the mesh before it, with triangles that it removes or
/// moves in violet; on the right the mesh after it, with marks in their colors and the selection in
/// violet. Both are seen from the direction that shows most of the changed or selected area.
///
/// @missing  an empty mesh after the edit is not drawn
/// @errors   Error(Input) as render_mesh for the mesh before
[[nodiscard]] Image<Rgb> edit_picture(const Mesh& before,
                                      const EditState& after,
                                      const EditPreview& preview,
                                      RenderOptions options = {},
                                      const Run& run = {});

}  // namespace frangia
