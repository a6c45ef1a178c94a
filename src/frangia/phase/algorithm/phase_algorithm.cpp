#include "frangia/phase/algorithm/phase_algorithm.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numeric>
#include <vector>

#include <Eigen/LU>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/phase/algorithm/algorithm_errors.h"
#include "frangia/phase/algorithm/published_algorithms.h"
#include "frangia/phase/internal/fringe_curve.h"
#include "frangia/rig/toml_reader.h"

namespace frangia {
namespace {

double weighted_sum(const std::vector<double>& weights, std::span<const double> counts) {
  return std::inner_product(weights.begin(), weights.end(), counts.begin(), 0.0);
}

/// Larkin and Oreb: N + 1 frames over a whole turn, the end frames with half weight.
void larkin_oreb(std::size_t frames, PhaseAlgorithm& out) {
  const double step = kTwoPi / static_cast<double>(frames - 1);
  for (std::size_t j = 0; j < frames; ++j) {
    const bool end = j == 0 || j + 1 == frames;
    const double angle = step * static_cast<double>(j);
    out.sine.push_back(end ? (j == 0 ? 0.5 : -0.5) / std::tan(step) : -std::sin(angle));
    out.cosine.push_back(end ? 0.5 : std::cos(angle));
  }
}

/// Surrel: a triangular window over two turns less one frame.
void surrel(std::size_t frames, PhaseAlgorithm& out) {
  const double n = static_cast<double>(frames + 1) / 2.0;
  for (std::size_t k = 0; k < frames; ++k) {
    const double index = static_cast<double>(k);
    const double weight = n - std::abs(index - (n - 1.0));
    out.sine.push_back(-weight * std::sin(kTwoPi / n * index));
    out.cosine.push_back(weight * std::cos(kTwoPi / n * index));
  }
}

/// Numerator and denominator as published, for shifts 0, step, 2 step, ...
PhaseAlgorithm published_coefficients(const std::string& name, std::size_t frames) {
  PhaseAlgorithm out{.name = name};
  const auto set = [&](std::vector<double> sine, std::vector<double> cosine) {
    out.sine = std::move(sine);
    out.cosine = std::move(cosine);
  };
  if (name == "3-step-90") set({0, -1, 1}, {1, -1, 0});
  if (name == "4-step") set({0, -1, 0, 1}, {1, 0, -1, 0});
  if (name == "schwider") set({1, -3, 1, 1}, {1, 1, -3, 1});
  if (name == "hariharan") set({0, 2, 0, -2, 0}, {-1, 0, 2, 0, -1});
  if (name == "schmit-creath") set({1, 0, -4, 0, 3, 0}, {0, 3, 0, -4, 0, 1});
  if (name == "de-groot") set({-1, 0, 7, 0, -7, 0, 1}, {0, -4, 0, 8, 0, -4, 0});
  if (name == "larkin-oreb") larkin_oreb(frames, out);
  if (name == "surrel") surrel(frames, out);
  if (name == "carre") {
    set({0, 1, -1, 0}, {-1, 1, 1, -1});
    out.outer = {1, 0, 0, -1};
  }
  return out;
}

struct SineAndCosine {
  double sine;
  double cosine;
};

/// B sin(phi) and B cos(phi) of a pixel, before the phase offset is subtracted.
SineAndCosine wave_of(const PhaseAlgorithm& algorithm, std::span<const double> counts) {
  SineAndCosine wave{weighted_sum(algorithm.sine, counts), weighted_sum(algorithm.cosine, counts)};
  if (!algorithm.outer.empty()) {
    const double u = wave.sine;
    const double v = weighted_sum(algorithm.outer, counts);
    wave.sine = std::copysign(std::sqrt(std::max(0.0, (3.0 * u - v) * (u + v))), u);
  }
  return wave;
}

/// Normalizes a published formula to B sin and B cos of the phase at shift zero. Offset and scale
/// follow from the result for a known phase.
void refer_to_shift_zero(const std::vector<double>& shifts_rad, PhaseAlgorithm& algorithm) {
  constexpr double kProbe_rad = 0.5;  // any phase whose sine and cosine are not 0
  const double step = common_step(shifts_rad);
  std::vector<double> counts;
  for (std::size_t k = 0; k < shifts_rad.size(); ++k)
    counts.push_back(std::cos(kProbe_rad + std::abs(step) * static_cast<double>(k)));
  const SineAndCosine wave = wave_of(algorithm, counts);
  const double size = std::hypot(wave.sine, wave.cosine);
  for (auto* weights : {&algorithm.sine, &algorithm.cosine, &algorithm.outer}) {
    for (double& weight : *weights)
      weight /= size;
  }
  subtract_phase_offset(std::atan2(wave.sine, wave.cosine) - kProbe_rad, algorithm);
  if (step < 0.0) {  // descending shifts measure -phi
    for (auto* weights : {&algorithm.sine, &algorithm.outer}) {
      for (double& weight : *weights)
        weight = -weight;
    }
    algorithm.phase_offset_rad = -algorithm.phase_offset_rad;
  }
  subtract_phase_offset(shifts_rad.front(), algorithm);
}

[[noreturn]] void throw_shift_mismatch(const PublishedAlgorithm& wanted,
                                       const std::vector<double>& shifts_rad) {
  std::vector<std::string> others;
  for (const PublishedAlgorithm& other : published_algorithms()) {
    if (fits(other, shifts_rad)) others.push_back(other.name);
  }
  throw Error(
      ErrorKind::Input,
      fmt::format(
          "the algorithm \"{}\" takes {}, which the {} shifts of the pattern do not match; {}",
          wanted.name,
          describe_frames(wanted),
          shifts_rad.size(),
          others.empty() ? "give at least 3" : fmt::format("use {}", fmt::join(others, ", "))));
}

}  // namespace

void compensate_gains(std::span<const double> gains,
                      double steady_share,
                      const std::vector<double>& shifts_rad,
                      PhaseAlgorithm& algorithm) {
  if (gains.empty()) return;
  const auto divide_by_gains = [&](std::vector<double>& weights) {
    for (std::size_t k = 0; k < gains.size(); ++k)
      weights[k] /= 1.0 + gains[k];
  };
  const auto of_mean = [&](const std::vector<double>& weights) {
    double sum = 0.0;
    for (std::size_t k = 0; k < gains.size(); ++k)
      sum += weights[k] * (1.0 + (1.0 - steady_share) * gains[k]);
    return sum;
  };
  std::vector<double> mean = least_squares(shifts_rad).mean;
  divide_by_gains(mean);
  for (auto* weights : {&algorithm.sine, &algorithm.cosine, &algorithm.mean, &algorithm.outer}) {
    if (weights->size() != gains.size()) continue;
    const double wanted = weights == &algorithm.mean ? 1.0 : 0.0;
    divide_by_gains(*weights);  // which leaves a share of the steady light
    const double left = (of_mean(*weights) - wanted) / of_mean(mean);
    for (std::size_t k = 0; k < gains.size(); ++k)
      (*weights)[k] -= left * mean[k];
  }
}

void subtract_phase_offset(double angle_rad, PhaseAlgorithm& algorithm) {
  if (!algorithm.outer.empty()) {
    algorithm.phase_offset_rad += angle_rad;
    return;
  }
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  for (std::size_t k = 0; k < algorithm.frames(); ++k) {
    const double sine = algorithm.sine[k];
    algorithm.sine[k] = sine * c - algorithm.cosine[k] * s;
    algorithm.cosine[k] = algorithm.cosine[k] * c + sine * s;
  }
}

double phase_of(const PhaseAlgorithm& algorithm, std::span<const double> counts) {
  const SineAndCosine wave = wave_of(algorithm, counts);
  return wrap_rad(std::atan2(wave.sine, wave.cosine) - algorithm.phase_offset_rad);
}

PhaseAlgorithm least_squares(const std::vector<double>& shifts_rad) {
  const Eigen::Matrix3d normal = fringe_normal_matrix(shifts_rad);
  const Eigen::Matrix3d inverse = normal.inverse();
  PhaseAlgorithm algorithm{.name = "least-squares"};
  for (const double shift : shifts_rad) {
    const Eigen::Vector3d weights = inverse * fringe_model_row(shift);
    algorithm.mean.push_back(weights(0));
    algorithm.cosine.push_back(weights(1));
    algorithm.sine.push_back(weights(2));
  }
  // The mean of (sine_k cos phi - cosine_k sin phi)^2 over phi, since the fit of a sinusoid is
  // exact.
  double square = 0.0;
  for (std::size_t k = 0; k < shifts_rad.size(); ++k)
    square += 0.5 * (std::pow(algorithm.sine[k], 2) + std::pow(algorithm.cosine[k], 2));
  algorithm.noise_gain = std::sqrt(square);
  return algorithm;
}

PhaseAlgorithm make_algorithm(const std::string& name,
                              const std::vector<double>& shifts_rad,
                              double gain_error) {
  const auto& all = published_algorithms();
  const auto published = std::find_if(
      all.begin(), all.end(), [&](const PublishedAlgorithm& one) { return one.name == name; });
  if (published == all.end()) {
    std::vector<std::string> names = {"auto"};
    for (const PublishedAlgorithm& one : all)
      names.push_back(one.name);
    throw Error(
        ErrorKind::Input,
        fmt::format("there is no algorithm \"{}\"; choose from {}", name, fmt::join(names, ", ")));
  }
  if (!fits(*published, shifts_rad)) throw_shift_mismatch(*published, shifts_rad);

  PhaseAlgorithm algorithm = published_coefficients(name, shifts_rad.size());
  const double mean_shift = std::accumulate(shifts_rad.begin(), shifts_rad.end(), 0.0) /
                            static_cast<double>(shifts_rad.size());
  if (name == "global-carre" || name == "aia") {  // these algorithms use the actual shifts
    std::vector<double> made = shifts_rad;
    for (double& shift : made)
      shift *= 1.0 + gain_error;
    algorithm = least_squares(made);
    algorithm.name = name;
    return algorithm;
  }
  if (algorithm.sine.empty()) {
    algorithm = least_squares(shifts_rad);
    algorithm.name = name;
  } else {
    algorithm.mean = least_squares(shifts_rad).mean;
    refer_to_shift_zero(shifts_rad, algorithm);
  }
  subtract_phase_offset(gain_error * mean_shift, algorithm);
  algorithm.noise_gain = noise_gain(algorithm, shifts_rad);
  return algorithm;
}

LinearAlgorithm read_algorithm(const std::filesystem::path& path, const Run& run) {
  const toml::table table = parse_toml(path, "frangia-algorithm");
  TomlReader reader(path, "", table);
  reader.ignore("format");
  reader.ignore("version");
  const std::string name = reader.text("name");
  std::vector<double> shifts_rad;
  for (const double shift : reader.numbers("shifts_deg"))
    shifts_rad.push_back(rad_from_deg(shift));
  const auto numerator = reader.numbers("numerator");
  const auto denominator = reader.numbers("denominator");
  reader.warn_of_unused_keys(run);
  try {
    return linear_algorithm(name, shifts_rad, numerator, denominator);
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("{}: {}", path.string(), error.what()));
  }
}

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
