#pragma once

#include <span>

#include "frangia/core/run.h"
#include "frangia/fusion/fuse_views.h"
#include "frangia/geometry/mesh.h"
#include "frangia/rig/camera_model.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// Gives the vertices the colors that the views see, blended by cos^2 / z^2 of the angle of
/// incidence and the distance, with weights that fall to zero towards the edges of what a view
/// measured. A view sees a vertex where its own points lie on the surface there: shadows and hidden
/// surfaces are thus excluded. Blending is done in linear light. Memory holds one view and four
/// numbers for each vertex.
///
/// @units    mm, object frame; sRGB, see `Mesh::colors`
/// @missing  a vertex that no view sees takes the mean color of its coloured neighbours; a part of
///           the mesh that no view sees is `kUnknownColor`; without colors of any view, the mesh is
///           left as it is
/// @errors   Error(Cancelled)
void color_vertices(Mesh& mesh,
                    const ViewStore& views,
                    const CameraModel& camera,
                    const Run& run = {});

/// Blends the colors that the views of several cameras see.
void color_vertices(Mesh& mesh, std::span<const CameraViews> cameras, const Run& run = {});

}  // namespace frangia
