#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "frangia/features/shape.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Vertices of a mesh near a sphere, and where its surface ends.
struct BallRegion {
  std::vector<std::size_t> vertices;     ///< on the sphere
  std::vector<Eigen::Vector3d> borders;  ///< unit directions from its center
};

/// Collects the measured vertices within `gate_mm` of a sphere. A vertex is on the border where a
/// triangle reaches from it beyond the sphere, or where the triangles around it do not close: its
/// edges then do not come in pairs.
[[nodiscard]] BallRegion ball_region(const Mesh& mesh, const Shape& sphere, double gate_mm);

}  // namespace frangia
