#include "frangia/calibrate/board/fit_phase_at.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include "frangia/core/linear_algebra.h"
#include "frangia/core/statistics.h"

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

namespace {

struct SinusoidFit {
  double mean = 0.0;
  double modulation = 0.0;
  double residual = 0.0;  ///< standard deviation of one frame
};

}  // namespace

double measure_fringe_misfit(const FrameStack& stack, std::span<const BoardPoint> points) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  constexpr int kParameters = 3;
  const auto frames = static_cast<Eigen::Index>(stack.frames.size());
  if (frames <= kParameters || points.empty()) return kNone;
  Eigen::MatrixXd terms(frames, kParameters);
  for (Eigen::Index i = 0; i < frames; ++i) {
    const double shift = stack.pattern.shifts_rad[static_cast<std::size_t>(i)];
    terms.row(i) << 1.0, std::cos(shift), std::sin(shift);
  }
  const Eigen::MatrixXd fit_of_counts =
      least_squares(terms, Eigen::MatrixXd::Identity(frames, frames));
  Eigen::AlignedBox2d box;
  for (const BoardPoint& point : points)
    box.extend(point.camera_px);
  const Frame& first = stack.frames.front();
  const int left = std::max(0, static_cast<int>(box.min().x()));
  const int top = std::max(0, static_cast<int>(box.min().y()));
  const int right = std::min(width_of(first), static_cast<int>(box.max().x()));
  const int bottom = std::min(height_of(first), static_cast<int>(box.max().y()));
  constexpr int kStride = 4;  // every sixteenth pixel is enough for a median
  std::vector<SinusoidFit> fits;
  Eigen::VectorXd counts(frames);
  for (int y = top; y < bottom; y += kStride) {
    for (int x = left; x < right; x += kStride) {
      for (Eigen::Index i = 0; i < frames; ++i)
        counts[i] = counts_at(stack.frames[static_cast<std::size_t>(i)], x, y);
      if (counts.maxCoeff() >= stack.white_level) continue;
      const Eigen::Vector3d fit = fit_of_counts * counts;
      const double squares = (counts - terms * fit).squaredNorm();
      fits.push_back({fit[0],
                      std::hypot(fit[1], fit[2]),
                      std::sqrt(squares / static_cast<double>(frames - kParameters))});
    }
  }
  if (fits.empty()) return kNone;
  // The light squares, by their mean: that of swapped frames is the same, their modulation is not.
  constexpr double kBright = 0.75;
  const auto bright =
      fits.begin() + static_cast<std::ptrdiff_t>(kBright * static_cast<double>(fits.size() - 1));
  std::nth_element(fits.begin(), bright, fits.end(), [](const auto& a, const auto& b) {
    return a.mean < b.mean;
  });
  std::vector<double> residuals;
  std::vector<double> modulations;
  for (auto fit = bright; fit != fits.end(); ++fit) {
    residuals.push_back(fit->residual);
    modulations.push_back(fit->modulation);
  }
  const double modulation = median(modulations);
  return modulation > 0.0 ? median(residuals) / modulation : kNone;
}

}  // namespace frangia
