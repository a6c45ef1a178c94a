#include "frangia/phase/phase_algorithm.h"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"

namespace frangia {
namespace {

/// How far a shift may lie from its place before an algorithm made for equal steps is refused.
constexpr double kStepTolerance_rad = 1e-3;

/// Below this the shifts are as good as singular: noise would be amplified a thousandfold.
constexpr double kLeastEigenvalueShare = 1e-6;

/// +1 or -1 for four steps of +90 or -90 degrees, 0 for any others.
int quarter_step_sign(const std::vector<double>& shifts_rad) {
  if (shifts_rad.size() != 4) return 0;
  for (const int sign : {1, -1}) {
    bool fits = true;
    for (std::size_t k = 1; k < shifts_rad.size(); ++k) {
      const double expected = shifts_rad[0] + sign * 0.5 * kPi * static_cast<double>(k);
      fits = fits && std::abs(wrap_rad(shifts_rad[k] - expected)) < kStepTolerance_rad;
    }
    if (fits) return sign;
  }
  return 0;
}

/// An algorithm published for shifts 0, step, 2 step ... referred to the shifts of these frames.
PhaseAlgorithm refer_to_shift(PhaseAlgorithm published, double first_rad, int sign) {
  // The published phase is sign * (phi + first): rotate it back, then undo the sign.
  const double c = std::cos(first_rad);
  const double s = std::sin(first_rad);
  for (std::size_t k = 0; k < published.sine.size(); ++k) {
    const double sine = sign * published.sine[k];
    const double cosine = published.cosine[k];
    published.sine[k] = sine * c - cosine * s;
    published.cosine[k] = cosine * c + sine * s;
  }
  return published;
}

}  // namespace

double PhaseAlgorithm::noise_gain() const {
  double sum = 0.0;
  for (std::size_t k = 0; k < sine.size(); ++k)
    sum += sine[k] * sine[k] + cosine[k] * cosine[k];
  return std::sqrt(0.5 * sum);
}

PhaseAlgorithm least_squares(const std::vector<double>& shifts_rad) {
  if (shifts_rad.size() < 3) {
    throw Error(
        ErrorKind::Input,
        fmt::format("{} shifts do not determine a phase; give at least 3", shifts_rad.size()));
  }
  // I = A + B cos(phi) cos(shift) - B sin(phi) sin(shift), in the three unknowns.
  const auto row = [](double shift) {
    return Eigen::Vector3d(1.0, std::cos(shift), -std::sin(shift));
  };
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  for (const double shift : shifts_rad)
    normal += row(shift) * row(shift).transpose();
  const Eigen::Vector3d eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>().computeDirect(normal).eigenvalues();
  if (!(eigenvalues(0) > kLeastEigenvalueShare * eigenvalues(2))) {
    throw Error(ErrorKind::Input,
                "shifts_deg does not determine a phase: at least three shifts must differ, modulo "
                "360 degrees");
  }
  const Eigen::Matrix3d inverse = normal.inverse();
  PhaseAlgorithm algorithm{.name = "least-squares"};
  for (const double shift : shifts_rad) {
    const Eigen::Vector3d weights = inverse * row(shift);
    algorithm.mean.push_back(weights(0));
    algorithm.cosine.push_back(weights(1));
    algorithm.sine.push_back(weights(2));
  }
  return algorithm;
}

PhaseAlgorithm schwider(const std::vector<double>& shifts_rad) {
  const int sign = quarter_step_sign(shifts_rad);
  if (sign == 0) {
    throw Error(ErrorKind::Input,
                "the algorithm \"schwider\" needs four shifts that are 90 degrees apart; use "
                "\"least-squares\" for these");
  }
  return refer_to_shift({.name = "schwider",
                         .sine = {0.25, -0.75, 0.25, 0.25},
                         .cosine = {0.25, 0.25, -0.75, 0.25},
                         .mean = {0.25, 0.25, 0.25, 0.25}},
                        shifts_rad.front(),
                        sign);
}

PhaseAlgorithm choose_algorithm(const std::string& name, const Pattern& pattern) {
  if (name == "schwider") return schwider(pattern.shifts_rad);
  if (name == "least-squares") return least_squares(pattern.shifts_rad);
  if (name != "auto") {
    throw Error(
        ErrorKind::Input,
        fmt::format("there is no algorithm \"{}\"; choose auto, schwider or least-squares", name));
  }
  const bool angular = pattern.fringes_per_degree > 0.0;
  return angular && quarter_step_sign(pattern.shifts_rad) != 0 ? schwider(pattern.shifts_rad)
                                                               : least_squares(pattern.shifts_rad);
}

}  // namespace frangia
