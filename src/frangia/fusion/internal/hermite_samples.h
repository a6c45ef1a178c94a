#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "frangia/core/chunked_vector.h"
#include "frangia/fusion/internal/edge_crossings.h"
#include "frangia/fusion/internal/hermite_accumulators.h"

namespace frangia {

/// Position and normal of the surface at one crossing, from the face with the largest weight.
///
/// @units    mm, object frame
struct HermiteSample {
  Eigen::Vector3f point;   ///< on the surface, nearest to the crossing
  Eigen::Vector3f normal;  ///< unit
  float noise_mm;          ///< standard deviation from independent noise
  float spacing_mm;        ///< of pixels on the surface
  float common_variance;   ///< variance common to neighbouring crossings
  std::uint16_t views;
  bool supported;   ///< see `HermiteAccumulators::is_supported`; otherwise the rest is undefined
  bool has_lesser;  ///< a second face near the crossing has enough weight to count
};

using HermiteSamples = ChunkedVector<HermiteSample>;

/// Returns one sample for each crossing.
[[nodiscard]] HermiteSamples make_hermite_samples(const EdgeCrossings& crossings,
                                                  const HermiteAccumulators& hermite,
                                                  const HermiteParameters& parameters = {});

/// Returns the sample of the second face near a crossing, the one with less weight.
[[nodiscard]] HermiteSample lesser_sample(const EdgeCrossings& crossings,
                                          const HermiteAccumulators& hermite,
                                          std::size_t crossing);

}  // namespace frangia
