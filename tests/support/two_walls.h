#pragma once

#include <cmath>
#include <cstdint>

#include "frangia/geometry/mesh.h"
#include "frangia/rig/projector.h"

namespace frangia::testing {

/// Depth of the line in which the walls meet.
inline constexpr double kWallsFar_mm = 5000.0;

/// A projector that looks along z from far away, 2 px a mm at the walls.
inline Projector far_projector(double x_mm = 0.0) {
  Projector projector;
  projector.model = PinholeModel{.width_px = 1001,
                                 .height_px = 1001,
                                 .focal_px = {10000.0, 10000.0},
                                 .principal_point_px = {500.0, 500.0}};
  projector.position_mm = {x_mm, 0.0, 0.0};
  return projector;
}

/// Two walls that meet at a right angle in the plane x = 0, as a mesh of `across` triangles along
/// each: open towards the projector (`sign` 1), or with their edge towards it (-1).
inline Mesh two_walls(double reach_mm, int across = 40, double sign = 1.0) {
  constexpr float kHalf_mm = 1000.0F;
  Mesh mesh;
  for (int i = -across; i <= across; ++i) {
    const double x = reach_mm * i / across;
    const auto z = static_cast<float>(kWallsFar_mm - sign * std::abs(x));
    for (const float y : {-kHalf_mm, kHalf_mm})
      mesh.vertices_mm.emplace_back(static_cast<float>(x), y, z);
  }
  for (std::uint32_t i = 0; i + 3 < mesh.vertices_mm.size(); i += 2) {
    mesh.triangles.push_back({i, i + 1, i + 2});
    mesh.triangles.push_back({i + 1, i + 3, i + 2});
  }
  return mesh;
}

}  // namespace frangia::testing
