#include "frangia/phase/waveform/internal/residual_model.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "frangia/phase/algorithm/phase_algorithm.h"

namespace frangia {

ResidualModel::ResidualModel(const FittedAlgorithm& fitted)
    : fit_(least_squares(fitted.shifts_rad)),
      waveform_(fitted.waveform.waveform),
      has_harmonics_(fitted.waveform.largest_harmonic() > 0),
      shifts_(fitted.shifts_rad),
      gains_(fitted.waveform.gains),
      steady_share_(fitted.waveform.steady_share) {
  gains_.resize(shifts_.size(), 0.0);
  for (const double shift : shifts_)
    directions_.emplace_back(std::cos(shift), -std::sin(shift));
}

bool ResidualModel::explains_something() const {
  return has_harmonics_ ||
         std::any_of(gains_.begin(), gains_.end(), [](double gain) { return gain != 0.0; });
}

PixelFringe ResidualModel::fringe_of(const std::vector<double>& counts) const {
  PixelFringe out;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    out.mean += fit_.mean[k] * counts[k];
    out.wave += Eigen::Vector2d(fit_.cosine[k], fit_.sine[k]) * counts[k];
  }
  return out;
}

double ResidualModel::squared_residual(const std::vector<double>& counts) const {
  const PixelFringe fringe = fringe_of(counts);
  double square = 0.0;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const double residual = counts[k] - fringe.mean - directions_[k].dot(fringe.wave);
    square += residual * residual;
  }
  return square;
}

double ResidualModel::unexplained_residual(std::vector<double>& counts) const {
  const double steady = steady_share_ * fringe_of(counts).mean;
  for (std::size_t k = 0; k < counts.size(); ++k)
    counts[k] = steady + (counts[k] - steady) / (1.0 + gains_[k]);
  if (has_harmonics_) {
    const Eigen::Vector2d wave = fringe_of(counts).wave;
    const double modulation = wave.norm();
    const double phase = std::atan2(wave.y(), wave.x());
    for (std::size_t k = 0; k < counts.size(); ++k) {
      const double angle = phase + shifts_[k];
      counts[k] -= modulation * (waveform_.light_at(angle) - std::cos(angle));
    }
  }
  return squared_residual(counts);
}

}  // namespace frangia
