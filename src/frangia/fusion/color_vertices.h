#pragma once

#include <span>

#include "frangia/core/run.h"
#include "frangia/fusion/fuse_views.h"
#include "frangia/geometry/mesh.h"
#include "frangia/rig/camera_model.h"
#include "frangia/views/view_store.h"

namespace frangia {

/// Weights of the blended colors and the test that a view sees a vertex.
struct ColorOptions {
  /// Cosine of the largest angle between a vertex normal and the ray to the camera: pixels that see
  /// the surface at a steeper angle are stretched over many vertices.
  double min_cosine = 0.1;
  /// Distance from the edge of the measured area over which the weight of a view rises from 0, so
  /// that no seam shows where a view ends; px.
  int ramp_px = 24;
  /// A view sees a vertex if the depths of the pixels around it differ by less than this many pixel
  /// sizes along the surface, plus as many standard deviations.
  double max_distance_px = 3.0;
};

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
                    const Run& run = {},
                    const ColorOptions& options = {});

/// Blends the colors that the views of several cameras see.
void color_vertices(Mesh& mesh,
                    std::span<const CameraViews> cameras,
                    const Run& run = {},
                    const ColorOptions& options = {});

}  // namespace frangia
