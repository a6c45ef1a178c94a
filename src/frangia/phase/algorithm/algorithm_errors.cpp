#include "frangia/phase/algorithm/algorithm_errors.h"

#include <algorithm>
#include <cmath>

#include "frangia/core/angles.h"

namespace frangia {
namespace {

constexpr int kPhasesPerFringe = 1440;  ///< phases per fringe: every quarter degree
constexpr double kSmall = 1e-5;         ///< of B: linear response, far above rounding

struct AddedHarmonic {
  int harmonic = 2;
  double share = 0.0;  ///< amplitude of the harmonic relative to B
};

std::vector<double> frames_of(double phi,
                              const std::vector<double>& shifts,
                              AddedHarmonic wave = {}) {
  std::vector<double> counts;
  for (const double shift : shifts)
    counts.push_back(std::cos(phi + shift) + wave.share * std::cos(wave.harmonic * (phi + shift)));
  return counts;
}

/// Calls `use(phi)` for phases over one fringe, offset so that no formula divides by zero.
template <typename Use>
void for_each_phase(const Use& use) {
  for (int i = 0; i < kPhasesPerFringe; ++i)
    use(kTwoPi * (i + 0.37) / kPhasesPerFringe);
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

/// Sum of the squared derivatives of the phase by the frames, for algorithms that are linear in the
/// frames: phi = atan2(S, C), so that dphi = (C dS - S dC) / (S^2 + C^2).
double squared_slope(const PhaseAlgorithm& algorithm, const std::vector<double>& counts) {
  double sine = 0.0;
  double cosine = 0.0;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    sine += algorithm.sine[k] * counts[k];
    cosine += algorithm.cosine[k] * counts[k];
  }
  double sum = 0.0;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const double slope = cosine * algorithm.sine[k] - sine * algorithm.cosine[k];
    sum += slope * slope;
  }
  const double square = sine * sine + cosine * cosine;
  return sum / (square * square);
}

/// The same by differences, for Carré's algorithm.
double squared_difference_slope(const PhaseAlgorithm& algorithm, std::vector<double> counts) {
  double sum = 0.0;
  for (double& count : counts) {
    const double unchanged = count;
    count = unchanged + kSmall;
    const double above = phase_of(algorithm, counts);
    count -= 2.0 * kSmall;
    const double slope = wrap_rad(above - phase_of(algorithm, counts)) / (2.0 * kSmall);
    sum += slope * slope;
    count = unchanged;
  }
  return sum;
}

}  // namespace

double noise_gain(const PhaseAlgorithm& algorithm, const std::vector<double>& shifts_rad) {
  double sum = 0.0;
  for_each_phase([&](double phi) {
    const std::vector<double> counts = frames_of(phi, shifts_rad);
    sum += algorithm.outer.empty() ? squared_slope(algorithm, counts)
                                   : squared_difference_slope(algorithm, counts);
  });
  return std::sqrt(sum / kPhasesPerFringe);
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
