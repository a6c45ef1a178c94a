#include "frangia/phase/internal/fringe_frequency.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <map>

#include "frangia/core/angles.h"
#include "frangia/core/vectorized.h"
#include "frangia/phase/internal/unwrap_level_lanes.h"
#include "frangia/phase/internal/wrap_tile.h"

namespace frangia {

double best_frequency(std::span<const double> places,
                      std::span<const float> phases_rad,
                      double declared,
                      double field) {
  constexpr double kFinest = 4.0;        // of the declared frequency
  constexpr double kMinAgreement = 0.5;  // mean of the cosines of the differences
  constexpr std::size_t kCoarse = 4;     // every fourth pixel for the search over all frequencies
  const auto agreement = [&](double frequency, std::size_t stride) {
    double sum = 0.0;
    for (std::size_t i = 0; i < places.size(); i += stride)
      sum += std::cos(static_cast<double>(phases_rad[i]) - kTwoPi * frequency * places[i]);
    return sum * static_cast<double>(stride) / static_cast<double>(places.size());
  };
  const double step = 0.2 / field;  // a fifth of a fringe over the field
  double best = 0.0;
  double most = 0.0;
  for (double frequency = step; frequency < kFinest * declared; frequency += step) {
    const double found = agreement(frequency, kCoarse);
    if (found <= most) continue;
    most = found;
    best = frequency;
  }
  most = agreement(best, 1);
  for (double width = 0.5 * step; width > 1e-4 * step; width *= 0.5) {
    for (const double frequency : {best - width, best + width}) {
      const double found = agreement(frequency, 1);
      if (found <= most) continue;
      most = found;
      best = frequency;
    }
  }
  return most > kMinAgreement ? best : 0.0;
}

double log_odds_of_frequency(std::span<const double> places,
                             std::span<const float> phases_rad,
                             double found,
                             double declared,
                             double tried) {
  constexpr double kPriorFault = 0.01;
  constexpr double kLeastSpread = 0.01;  // 1 - R^2 of exact borders: blur, harmonics
  std::map<double, std::complex<double>> sums;
  for (std::size_t i = 0; i < places.size(); ++i)
    sums[places[i]] += std::polar(1.0, static_cast<double>(phases_rad[i]));
  const auto spread = [&](double frequency) {
    std::complex<double> mean;
    for (const auto& [place, sum] : sums) {
      const double size = std::abs(sum);
      if (size > 0.0) mean += sum / size * std::polar(1.0, -kTwoPi * frequency * place);
    }
    mean /= static_cast<double>(sums.size());
    return std::max(1.0 - std::norm(mean), kLeastSpread);
  };
  return static_cast<double>(sums.size()) * std::log(spread(declared) / spread(found)) -
         std::log(tried) + std::log(kPriorFault);
}

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
