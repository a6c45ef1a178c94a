#include "frangia/phase/algorithm/linear_algorithm.h"

#include <cmath>
#include <complex>
#include <cstddef>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/phase/algorithm/algorithm_errors.h"

namespace frangia {
namespace {

using Complex = std::complex<double>;

/// What the filter c_k = denominator + i numerator makes of 1, exp(i phi) and exp(-i phi).
struct Answers {
  Complex constant;
  Complex phase;
  Complex mirrored;
  double size = 0.0;  ///< sum of |c_k|
};

Answers answers_of(const std::vector<double>& shifts_rad,
                   const std::vector<double>& numerator,
                   const std::vector<double>& denominator) {
  Answers out;
  for (std::size_t k = 0; k < shifts_rad.size(); ++k) {
    const Complex c(denominator[k], numerator[k]);
    out.constant += c;
    out.phase += 0.5 * c * std::polar(1.0, shifts_rad[k]);
    out.mirrored += 0.5 * c * std::polar(1.0, -shifts_rad[k]);
    out.size += std::abs(c);
  }
  return out;
}

[[noreturn]] void refuse(const std::string& name, const std::string& what) {
  throw Error(ErrorKind::Input, fmt::format("algorithm \"{}\": {}", name, what));
}

void check(const std::string& name, const Answers& answers) {
  constexpr double kNone = 1e-6;  // of the coefficients' sum
  const double none = kNone * answers.size;
  if (!(std::abs(answers.phase) > none)) {
    refuse(name,
           std::abs(answers.mirrored) > none
               ? "it returns the negative phase; change the sign of the numerator"
               : "its sums do not depend on the phase; check the coefficients and the shifts");
  }
  if (std::abs(answers.constant) > none)
    refuse(name, "its result depends on the mean intensity; each list must sum to zero");
  if (std::abs(answers.mirrored) > none) {
    refuse(name,
           fmt::format("its two sums are not the sine and the cosine of one angle: the phase would "
                       "have an error of up to {:.2g} rad; check the coefficients and the shifts",
                       std::asin(std::min(1.0, std::abs(answers.mirrored / answers.phase)))));
  }
}

}  // namespace

LinearAlgorithm linear_algorithm(const std::string& name,
                                 const std::vector<double>& shifts_rad,
                                 const std::vector<double>& numerator,
                                 const std::vector<double>& denominator) {
  if (numerator.size() != shifts_rad.size() || denominator.size() != shifts_rad.size()) {
    refuse(name,
           fmt::format("there are {} shifts, {} coefficients of the numerator and {} of the "
                       "denominator; give one of each for each frame",
                       shifts_rad.size(),
                       numerator.size(),
                       denominator.size()));
  }
  const PhaseAlgorithm mean = least_squares(shifts_rad);  // checks the shifts
  const Answers answers = answers_of(shifts_rad, numerator, denominator);
  check(name, answers);
  LinearAlgorithm out{{.name = name, .mean = mean.mean}, shifts_rad};
  for (std::size_t k = 0; k < shifts_rad.size(); ++k) {
    const Complex c = Complex(denominator[k], numerator[k]) / answers.phase;
    out.algorithm.cosine.push_back(c.real());
    out.algorithm.sine.push_back(c.imag());
  }
  out.algorithm.noise_gain = noise_gain(out.algorithm, shifts_rad);
  return out;
}

bool fits(const LinearAlgorithm& algorithm, const std::vector<double>& shifts_rad) {
  constexpr double kSame_rad = 1e-6;
  if (algorithm.shifts_rad.size() != shifts_rad.size()) return false;
  for (std::size_t k = 0; k < shifts_rad.size(); ++k) {
    if (std::abs(std::remainder(algorithm.shifts_rad[k] - shifts_rad[k], kTwoPi)) > kSame_rad)
      return false;
  }
  return true;
}

}  // namespace frangia
