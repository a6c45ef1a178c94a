#include "frangia/calibrate/board/fit_phase_at.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "frangia/core/median.h"
#include "frangia/core/solve_symmetric.h"

namespace frangia {
namespace {

constexpr int kTerms = 6;  // 1 x y x^2 xy y^2
using Terms = Eigen::Matrix<double, kTerms, 1>;

struct Sample {
  Terms terms;
  double phase_rad = 0.0;
  double weight = 0.0;  ///< 1 / sigma^2
};

std::vector<Sample> samples_around(const Image<float>& phase_rad,
                                   const Image<float>& sigma_rad,
                                   const Eigen::Vector2d& point_px,
                                   int radius_px) {
  std::vector<Sample> samples;
  const int middle_x = static_cast<int>(std::lround(point_px.x()));
  const int middle_y = static_cast<int>(std::lround(point_px.y()));
  for (int y = std::max(0, middle_y - radius_px);
       y <= std::min(phase_rad.height() - 1, middle_y + radius_px);
       ++y) {
    for (int x = std::max(0, middle_x - radius_px);
         x <= std::min(phase_rad.width() - 1, middle_x + radius_px);
         ++x) {
      const auto phase = static_cast<double>(phase_rad(x, y));
      const auto sigma = static_cast<double>(sigma_rad(x, y));
      if (std::isnan(phase) || !(sigma > 0.0)) continue;
      const double u = (x - point_px.x()) / radius_px;
      const double v = (y - point_px.y()) / radius_px;
      Sample sample;
      sample.terms << 1.0, u, v, u * u, u * v, v * v;
      sample.phase_rad = phase;
      sample.weight = 1.0 / (sigma * sigma);
      samples.push_back(sample);
    }
  }
  return samples;
}

}  // namespace

PhaseAt fit_phase_at(const Image<float>& phase_rad,
                     const Image<float>& sigma_rad,
                     const Eigen::Vector2d& point_px,
                     const PhaseFitOptions& options) {
  const std::vector<Sample> samples =
      samples_around(phase_rad, sigma_rad, point_px, options.radius_px);
  if (samples.size() < static_cast<std::size_t>(options.min_pixels)) return {};
  // Robust from the start: a neighboring surface may fill a part of the window.
  std::vector<double> phases;
  for (const Sample& sample : samples)
    phases.push_back(sample.phase_rad);
  Terms fitted = Terms::Zero();
  fitted[0] = median(phases);
  double gate = std::numeric_limits<double>::infinity();
  constexpr int kIterations = 8;
  constexpr double kTukey = 4.685 * 1.4826;  // medians of the weighted residuals
  Eigen::Matrix<double, kTerms, kTerms> normal;
  double left_over = 0.0;
  double used = 0.0;
  for (int i = 0; i < kIterations; ++i) {
    normal.setZero();
    Terms right = Terms::Zero();
    std::vector<double> residuals;
    left_over = 0.0;
    used = 0.0;
    for (const Sample& sample : samples) {
      const double residual =
          std::sqrt(sample.weight) * (sample.phase_rad - fitted.dot(sample.terms));
      residuals.push_back(std::abs(residual));
      const double ratio = residual / gate;
      if (!(std::abs(ratio) < 1.0)) continue;
      const double trust = (1.0 - ratio * ratio) * (1.0 - ratio * ratio);
      normal += trust * sample.weight * sample.terms * sample.terms.transpose();
      right += trust * sample.weight * sample.phase_rad * sample.terms;
      left_over += trust * residual * residual;
      used += trust;
    }
    if (used < options.min_pixels) return {};
    fitted = solve_symmetric(normal, right);
    gate = std::max(kTukey * median(residuals), kTukey * 0.5);
  }
  const double variance = solve_symmetric(normal, Terms::Unit(0))[0];
  const double excess = std::max(1.0, left_over / std::max(1.0, used - kTerms));
  if (!(variance > 0.0) || !std::isfinite(fitted[0])) return {};
  return {fitted[0],
          std::sqrt(variance * excess),
          Eigen::Vector2d(fitted[1], fitted[2]) / options.radius_px};
}

}  // namespace frangia
