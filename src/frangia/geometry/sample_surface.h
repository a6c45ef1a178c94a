#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "frangia/geometry/mesh.h"

namespace frangia {

struct SurfaceSample {
  Eigen::Vector3d point_mm;
  Eigen::Vector3d normal;  ///< of the triangle, unit, outward
  std::uint32_t triangle = 0;
};

/// Points spread evenly over the area of a mesh, the same for the same seed.
///
/// shape    `count` samples; none for a mesh without area
/// source   stratified along the area: one sample in each of `count` equal parts of it
[[nodiscard]] std::vector<SurfaceSample> sample_surface(const Mesh& mesh,
                                                        std::size_t count,
                                                        std::uint64_t seed = 1);

}  // namespace frangia
