#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// A point on the surface of a mesh.
struct SurfaceSample {
  Eigen::Vector3d point_mm;    ///< position on the triangle
  Eigen::Vector3d normal;      ///< of the triangle, unit, outward
  std::uint32_t triangle = 0;  ///< index into the mesh
};

/// Samples points uniformly over the area of a mesh. Equal seeds give equal points.
///
/// @shape    `count` samples; none for a mesh without area
/// @source   stratified by area: one sample in each of `count` equal parts; Turk 1990 in a triangle
[[nodiscard]] std::vector<SurfaceSample> sample_surface(const Mesh& mesh,
                                                        std::size_t count,
                                                        std::uint64_t seed = 1);

}  // namespace frangia
