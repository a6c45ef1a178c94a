#include "frangia/phase/internal/frequency_slope.h"

#include <cmath>

#include "frangia/core/vectorized.h"
#include "frangia/phase/internal/lane_math.h"
#include "frangia/phase/internal/wrap_tile.h"

namespace frangia {
namespace {

/// The contribution of a map to the slope of phase over frequency.
struct MapTerm {
  const float* phase;
  const float* precision;
  float ratio;  ///< frequency relative to the finest map
};

/// Sums of the least-squares slope of phase over frequency.
struct Slope {
  alignas(64) Lane sum;
  alignas(64) Lane weights;
};

/// Adds two maps to the sums, as deviations from the finest map's phase. The first two maps
/// initialize the sums.
template <bool IsFirst>
FRANGIA_VECTORIZED void add_to_slope(const MapTerm& first,
                                     const MapTerm& second,
                                     const float* __restrict at,
                                     std::size_t n,
                                     Slope& __restrict slope) {
  const MapTerm a = first;
  const MapTerm b = second;
  for (std::size_t i = 0; i < n; ++i) {
    const float away_a = a.phase[i] - a.ratio * at[i];
    const float away_b = b.phase[i] - b.ratio * at[i];
    const float weight_a = a.ratio * a.precision[i];
    const float weight_b = b.ratio * b.precision[i];
    const float found = weight_a * wrap_lane(away_a) + weight_b * wrap_lane(away_b);
    const float weight = weight_a * a.ratio + weight_b * b.ratio;
    slope.sum[i] = IsFirst ? found : slope.sum[i] + found;
    slope.weights[i] = IsFirst ? weight : slope.weights[i] + weight;
  }
}

FRANGIA_VECTORIZED void finish_slope(const float* __restrict at,
                                     const Slope& __restrict slope,
                                     std::size_t n,
                                     float* __restrict absolute,
                                     float* __restrict sigma) {
  for (std::size_t i = 0; i < n; ++i) {
    const float variance = 1.0F / slope.weights[i];
    absolute[i] = at[i] + slope.sum[i] * variance;
    sigma[i] = std::sqrt(variance);
  }
}

}  // namespace

void fit_frequency_slope(const TilePhases& maps,
                         std::span<const double> ratios,
                         const float* at,
                         std::size_t n,
                         float* absolute_rad,
                         float* sigma_rad) {
  Slope slope;  // NOLINT(cppcoreguidelines-pro-type-member-init): initialized by the first two maps
  for (std::size_t m = 0; m < ratios.size(); m += 2) {
    // The last map of an odd number is paired with itself at weight zero.
    const bool pair = m + 1 < ratios.size();
    const std::size_t other = pair ? m + 1 : m;
    const MapTerm one{maps.phase_rad[m], maps.precision[m], static_cast<float>(ratios[m])};
    const MapTerm two{maps.phase_rad[other],
                      maps.precision[other],
                      pair ? static_cast<float>(ratios[other]) : 0.0F};
    (m == 0 ? add_to_slope<true> : add_to_slope<false>)(one, two, at, n, slope);
  }
  finish_slope(at, slope, n, absolute_rad, sigma_rad);
}

}  // namespace frangia
