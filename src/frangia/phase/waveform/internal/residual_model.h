#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "frangia/phase/algorithm/fit_algorithm.h"

namespace frangia {

/// The fringe model of one pattern with what its frames add to it.
class ResidualModel {
 public:
  explicit ResidualModel(const FittedAlgorithm& fitted)
      : fit_(least_squares(fitted.shifts_rad)),
        waveform_(fitted.waveform.waveform),
        has_harmonics_(fitted.waveform.largest_harmonic() > 0),
        shifts_(fitted.shifts_rad),
        gains_(fitted.waveform.gains) {
    gains_.resize(shifts_.size(), 0.0);
    for (const double shift : shifts_)
      directions_.emplace_back(std::cos(shift), -std::sin(shift));
  }
  [[nodiscard]] bool explains_something() const {
    return has_harmonics_ ||
           std::any_of(gains_.begin(), gains_.end(), [](double gain) { return gain != 0.0; });
  }

  /// Sum of the squared residuals of a pixel from its least-squares fringe; linear in the frames.
  [[nodiscard]] double squared_residual(const std::vector<double>& counts) const {
    const auto [mean, wave] = fringe_of(counts);
    double square = 0.0;
    for (std::size_t k = 0; k < counts.size(); ++k) {
      const double residual = counts[k] - mean - directions_[k].dot(wave);
      square += residual * residual;
    }
    return square;
  }

  /// The same after removing gains and harmonics from the counts.
  [[nodiscard]] double unexplained_residual(std::vector<double>& counts) const {
    for (std::size_t k = 0; k < counts.size(); ++k)
      counts[k] /= 1.0 + gains_[k];
    if (has_harmonics_) {
      const Eigen::Vector2d wave = fringe_of(counts).second;
      const double modulation = wave.norm();
      const double phase = std::atan2(wave.y(), wave.x());
      for (std::size_t k = 0; k < counts.size(); ++k) {
        const double angle = phase + shifts_[k];
        counts[k] -= modulation * (waveform_.light_at(angle) - std::cos(angle));
      }
    }
    return squared_residual(counts);
  }

 private:
  [[nodiscard]] std::pair<double, Eigen::Vector2d> fringe_of(
      const std::vector<double>& counts) const {
    double mean = 0.0;
    Eigen::Vector2d wave = Eigen::Vector2d::Zero();
    for (std::size_t k = 0; k < counts.size(); ++k) {
      mean += fit_.mean[k] * counts[k];
      wave += Eigen::Vector2d(fit_.cosine[k], fit_.sine[k]) * counts[k];
    }
    return {mean, wave};
  }

  PhaseAlgorithm fit_;
  FringeWaveform waveform_;
  bool has_harmonics_;
  std::vector<double> shifts_;
  std::vector<double> gains_;
  std::vector<Eigen::Vector2d> directions_;  ///< of the wave in the frames
};

}  // namespace frangia
