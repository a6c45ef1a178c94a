#include "frangia/phase/algorithm_errors.h"

#include <algorithm>
#include <cmath>

#include "frangia/core/angles.h"

namespace frangia {
namespace {

constexpr int kPhases = 1440;    ///< phases per fringe: every quarter degree
constexpr double kSmall = 1e-5;  ///< of B: linear response, far above rounding

struct Wave {
  int harmonic = 2;
  double share = 0.0;  ///< amplitude of the harmonic relative to B
};

std::vector<double> frames_of(double phi, const std::vector<double>& shifts, Wave wave = {}) {
  std::vector<double> counts;
  for (const double shift : shifts)
    counts.push_back(std::cos(phi + shift) + wave.share * std::cos(wave.harmonic * (phi + shift)));
  return counts;
}

/// Calls `use(phi)` for phases over one fringe, offset so that no formula divides by zero.
template <typename Use>
void for_each_phase(const Use& use) {
  for (int i = 0; i < kPhases; ++i)
    use(kTwoPi * (i + 0.37) / kPhases);
}

double harmonic_error(const PhaseAlgorithm& algorithm,
                      const std::vector<double>& shifts,
                      int harmonic) {
  double worst = 0.0;
  for_each_phase([&](double phi) {
    const double found = phase_of(algorithm, frames_of(phi, shifts, {harmonic, kSmall}));
    worst = std::max(worst, std::abs(wrap_rad(found - phi)) / kSmall);
  });
  return worst;
}

}  // namespace

double noise_gain(const PhaseAlgorithm& algorithm, const std::vector<double>& shifts_rad) {
  double sum = 0.0;
  for_each_phase([&](double phi) {
    for (std::size_t k = 0; k < shifts_rad.size(); ++k) {
      auto counts = frames_of(phi, shifts_rad);
      counts[k] += kSmall;
      const double above = phase_of(algorithm, counts);
      counts[k] -= 2.0 * kSmall;
      const double slope = wrap_rad(above - phase_of(algorithm, counts)) / (2.0 * kSmall);
      sum += slope * slope;
    }
  });
  return std::sqrt(sum / kPhases);
}

double ripple(const PhaseAlgorithm& algorithm,
              const std::vector<double>& shifts_rad,
              double error) {
  std::vector<double> made = shifts_rad;
  for (double& shift : made)
    shift *= 1.0 + error;
  double low = kTwoPi;
  double high = -kTwoPi;
  for_each_phase([&](double phi) {
    const double off = wrap_rad(phase_of(algorithm, frames_of(phi, made)) - phi);
    low = std::min(low, off);
    high = std::max(high, off);
  });
  return high - low;
}

AlgorithmErrors algorithm_errors(const PhaseAlgorithm& algorithm,
                                 const std::vector<double>& shifts_rad,
                                 bool step_known) {
  const auto at = [&](double error) {
    return ripple(step_known ? make_algorithm(algorithm.name, shifts_rad, error) : algorithm,
                  shifts_rad,
                  error);
  };
  return {.ripple_rad = 0.5 * (at(0.05) + at(-0.05)),
          .noise_gain = noise_gain(algorithm, shifts_rad),
          .second_harmonic = harmonic_error(algorithm, shifts_rad, 2),
          .third_harmonic = harmonic_error(algorithm, shifts_rad, 3)};
}

}  // namespace frangia
