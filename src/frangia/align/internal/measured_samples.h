#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "frangia/geometry/mesh.h"

namespace frangia {

/// A sample of the measured surface.
struct MeasuredSample {
  Eigen::Vector3d point_mm;
  Eigen::Vector3d normal;
  double sigma_mm = 0.0;  ///< combined; 0 when unknown
};

/// Samples the measured triangles of a mesh evenly over their area, in random order: the first n
/// samples are spread over the whole surface, too.
///
/// @errors   Error(Input) when no triangle is measured
[[nodiscard]] std::vector<MeasuredSample> measured_samples(const Mesh& mesh,
                                                           std::size_t count,
                                                           std::uint64_t seed);

}  // namespace frangia
