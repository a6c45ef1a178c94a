#include "frangia/phase/internal/best_frequency.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <map>

#include "frangia/core/angles.h"

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

}  // namespace frangia
