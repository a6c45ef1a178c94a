#include "frangia/decode/explain/internal/reference_light.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "frangia/core/angles.h"
#include "frangia/core/statistics.h"
#include "frangia/decode/explain/internal/log_densities.h"

namespace frangia {
namespace {

/// Relative standard deviations of mean and modulation: what blur and ambient light differ between
/// patterns at least, and without knowledge.
constexpr double kLeastSpread = 0.02;
constexpr double kUnknown = 0.5;
/// Largest spread of patterns that agree: of mean and modulation by blur, and of the phase times
/// their ratio by harmonics, rad.
constexpr double kMostSpread = 0.1;
constexpr double kMostPhaseSpread_rad = 0.6;
/// Share of the pixels of which other patterns say nothing: depth edges, indirect light.
constexpr double kStray = 0.05;
/// Relative standard deviation of the mean light of patterns: flicker of 3 % over a few frames.
constexpr double kMeanLight = 0.02;

/// The middle of finite values of counted pixels, and how far most of them are from it.
struct MostValues {
  double middle = 1.0;
  double spread = kUnknown;
};

MostValues most_of(const Eigen::ArrayXd& all, const Eigen::ArrayXd& counted) {
  std::vector<double> some;
  for (Eigen::Index i = 0; i < all.size(); ++i)
    if (counted(i) > 0.0 && std::isfinite(all(i))) some.push_back(all(i));
  if (some.empty()) return {};
  MostValues out;
  out.middle = median(some);
  for (double& one : some)
    one = std::abs(one - out.middle);
  out.spread = std::max(median(some) / kMedianOfNormal, kLeastSpread);
  return out;
}

/// Adds how much more likely the phases are by that of another pattern.
void add_phases(const FrameSample& sample,
                const Eigen::MatrixXd& values,
                const Eigen::ArrayXd& counted,
                Eigen::ArrayXd& gain) {
  Eigen::ArrayXd off(gain.size());
  std::complex<double> sum = 0.0;
  for (Eigen::Index i = 0; i < off.size(); ++i) {
    off(i) = sample.periods * std::atan2(values(i, 2), values(i, 1)) -
             sample.reference_periods * sample.reference_phase_rad(i);
    if (counted(i) > 0.0 && std::isfinite(off(i))) sum += std::polar(1.0, off(i));
  }
  const double middle = std::arg(sum);
  for (double& one : off)
    one = wrap_rad(one - middle);
  const double spread = std::min(most_of(off, counted).spread, kMostPhaseSpread_rad);
  const double noise_factor =
      0.5 * (std::pow(sample.periods, 2) + std::pow(sample.reference_periods, 2));
  const double unknown = -std::log(kTwoPi);
  for (Eigen::Index i = 0; i < off.size(); ++i) {
    const double square = std::pow(sample.reference_modulation(i), 2);
    if (!std::isfinite(off(i)) || !std::isfinite(square)) continue;
    const double variance = spread * spread + noise_factor * sample.variance(i) / square;
    const double agreed = std::log(1.0 - kStray) + log_normal(off(i) * off(i), variance, 1.0);
    gain(i) += log_of_mixture(agreed, std::log(kStray) + unknown) - unknown;
  }
}

}  // namespace

ReferenceGain reference_gain(const FrameSample& sample,
                             const Eigen::MatrixXd& values,
                             const Eigen::ArrayXd& counted) {
  const Eigen::ArrayXd modulation =
      (values.col(1).array().square() + values.col(2).array().square()).sqrt();
  const Eigen::ArrayXd means = values.col(0).array() / sample.reference_mean;
  const Eigen::ArrayXd modulations = modulation / sample.reference_modulation;
  const MostValues of_means = most_of(means, counted);
  const MostValues of_modulations = most_of(modulations, counted);
  const double unknown = 2.0 * log_normal(0.0, kUnknown * kUnknown, 1.0);
  ReferenceGain out{.pixels = Eigen::ArrayXd::Zero(means.size())};
  for (Eigen::Index i = 0; i < means.size(); ++i) {
    if (!std::isfinite(means(i)) || !std::isfinite(modulations(i))) continue;
    const double noise = std::sqrt(sample.variance(i));  // of a few frames together
    double agreed = std::log(1.0 - kStray);
    const auto add = [&](double off, const MostValues& most, double reference) {
      const double spread = std::min(most.spread, kMostSpread);
      const double variance = spread * spread + std::pow(noise / reference, 2);
      agreed += log_normal(off * off, variance, 1.0);
    };
    add(means(i) - of_means.middle, of_means, sample.reference_mean(i));
    add(modulations(i) - of_modulations.middle, of_modulations, sample.reference_modulation(i));
    out.pixels(i) = log_of_mixture(agreed, std::log(kStray) + unknown) - unknown;
  }
  if (sample.reference_phase_rad.size() > 0) add_phases(sample, values, counted, out.pixels);
  out.common = -0.5 * std::pow((of_means.middle - 1.0) / kMeanLight, 2);
  return out;
}

}  // namespace frangia
