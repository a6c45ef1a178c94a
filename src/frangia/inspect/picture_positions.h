#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "frangia/geometry/ray_scene.h"
#include "frangia/inspect/render_mesh.h"

namespace frangia {

/// A place on a surface.
struct PicturedPlace {
  Eigen::Vector3d point_mm = Eigen::Vector3d::Zero();  ///< its position
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();   ///< unit, outward
};

/// Where `render_mesh` with the same options draws places of a mesh, without its legend.
///
/// @shape    one for each place
/// @units    pixels from the upper left corner
/// @missing  none for a place that faces away, is hidden by the mesh or lies outside of the picture
[[nodiscard]] std::vector<std::optional<Eigen::Vector2d>> picture_positions(
    const RayScene& mesh, const RenderOptions& options, const std::vector<PicturedPlace>& places);

}  // namespace frangia
