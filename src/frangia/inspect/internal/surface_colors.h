#pragma once

#include <Eigen/Core>

#include "frangia/frames/picture_legend.h"
#include "frangia/geometry/mesh.h"
#include "frangia/geometry/ray_scene.h"
#include "frangia/inspect/render_mesh.h"

namespace frangia {

/// Linear color of the back side of triangles: a magenta at least 20 degrees of chromaticity away
/// from every color of the maps, so that it cannot be mistaken for a value.
[[nodiscard]] Eigen::Vector3d inside_color();

/// Linear color of a surface before lighting: highlighted, marked, mapped from its value, or plain.
[[nodiscard]] Eigen::Vector3d front_color(const Mesh& mesh,
                                          const RenderOptions& options,
                                          const RayHit& hit);

/// The legend of the colors in a picture: the scale of the values, and those of highlights, marks,
/// missing values and the inside that the mesh has. Empty for a plain picture.
[[nodiscard]] PictureLegend surface_legend(const Mesh& mesh, const RenderOptions& options);

}  // namespace frangia
