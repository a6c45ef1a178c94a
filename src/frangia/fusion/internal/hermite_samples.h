#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "frangia/core/chunked_vector.h"
#include "frangia/fusion/internal/edge_crossings.h"
#include "frangia/fusion/internal/hermite_accumulators.h"

namespace frangia {

/// The surface at one crossing, as most of the views that saw it say: what the four cells around it
/// take.
///
/// units    mm, object frame
struct HermiteSample {
  Eigen::Vector3f point;   ///< of the surface, nearest to the crossing
  Eigen::Vector3f normal;  ///< unit
  float noise_mm;          ///< what the views' noise leaves of itself
  float spacing_mm;        ///< of pixels
  float common_variance;   ///< variance that does not average away between neighbours
  std::uint16_t views;
  bool supported;  ///< see `HermiteAccumulators::is_supported`; the rest says nothing where it does
                   ///< not
  bool has_lesser;  ///< another face runs near, and more than chance speaks for it
};

using HermiteSamples = ChunkedVector<HermiteSample>;

/// One facet a crossing.
[[nodiscard]] HermiteSamples make_hermite_samples(const EdgeCrossings& crossings,
                                                  const HermiteAccumulators& hermite);

/// The plane of the other face near a crossing.
[[nodiscard]] HermiteSample lesser_sample(const EdgeCrossings& crossings,
                                          const HermiteAccumulators& hermite,
                                          std::size_t crossing);

}  // namespace frangia
