#include "frangia/phase/internal/fringe_bins.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "frangia/core/statistics.h"
#include "frangia/phase/algorithm/phase_algorithm.h"

namespace frangia {
namespace {

/// Largest phase noise of a pixel that contributes, rad: as WrapOptions::max_sigma_rad.
constexpr double kMaxBinnedSigma = 0.1;

/// Largest departure of a pixel's log contrast from the median. A harmonic of 40 % changes it by
/// 0.5; pixels on depth edges exceed it.
constexpr double kMaxLogContrast = 0.7;

/// Sampled pixels: their counts, one column per frame, and their tiles.
struct GridSamples {
  Eigen::ArrayXXf counts;
  std::vector<std::int32_t> tile;
};

GridSamples sample_grid(const FrameStack& stack, std::size_t samples) {
  const int width = width_of(stack.frames.front());
  const int height = height_of(stack.frames.front());
  const double all = static_cast<double>(width) * height;
  const int stride = std::max(
      1, static_cast<int>(std::sqrt(all / static_cast<double>(std::max<std::size_t>(1, samples)))));
  const Eigen::Index rows =
      Eigen::Index{(width + stride - 1) / stride} * ((height + stride - 1) / stride);
  GridSamples out{Eigen::ArrayXXf(rows, std::ssize(stack.frames)), {}};
  out.tile.reserve(static_cast<std::size_t>(rows));
  for (int y = 0; y < height; y += stride) {
    for (int x = 0; x < width; x += stride)
      out.tile.push_back(y * kContrastTiles / height * kContrastTiles + x * kContrastTiles / width);
  }
  for (std::size_t k = 0; k < stack.frames.size(); ++k) {
    std::visit(
        [&](const auto& image) {
          Eigen::Index row = 0;
          for (int y = 0; y < height; y += stride) {
            for (int x = 0; x < width; x += stride)
              out.counts(row++, static_cast<Eigen::Index>(k)) = static_cast<float>(image(x, y));
          }
        },
        stack.frames[k]);
  }
  return out;
}

/// Whether each pixel's frames are below saturation, by a margin of three sigmas. Counts cut off at
/// 0 stay: their phases are measured, and have the error of the harmonics that the cut makes.
Eigen::Array<bool, Eigen::Dynamic, 1> unsaturated(const Eigen::ArrayXXf& counts,
                                                  int white_level,
                                                  const NoiseModel& noise) {
  const auto high = static_cast<float>(white_level - 3.0 * std::sqrt(noise.variance(white_level)));
  return counts.rowwise().maxCoeff() < high;
}

/// Levels of modulation, relative to the largest, of which few pixels are saturated. At other
/// levels the phase decides which pixels are saturated, and the remaining ones are a selection by
/// phase.
class ModulationLevels {
 public:
  explicit ModulationLevels(double largest) : largest_(largest) {}
  void add(double modulation, bool is_unsaturated) {
    all_[level_of(modulation)] += 1;
    saturated_[level_of(modulation)] += is_unsaturated ? 0 : 1;
  }
  [[nodiscard]] bool accepts(double modulation) const {
    const std::size_t level = level_of(modulation);
    return saturated_[level] <= kMaxSaturated * all_[level];
  }

 private:
  static constexpr std::size_t kLevels = 32;
  static constexpr double kMaxSaturated = 0.05;
  [[nodiscard]] std::size_t level_of(double modulation) const {
    return std::min(kLevels - 1, static_cast<std::size_t>(modulation / largest_ * kLevels));
  }
  double largest_;
  std::array<double, kLevels> all_{};
  std::array<double, kLevels> saturated_{};
};

Eigen::VectorXd vector_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values));
}

}  // namespace

FringeBins bin_fringes(const FrameStack& stack,
                       const std::vector<double>& shifts_rad,
                       const NoiseModel& noise,
                       std::size_t samples) {
  const PhaseAlgorithm fit = least_squares(shifts_rad);
  const Eigen::Index frames = std::ssize(shifts_rad);
  FringeBins out;
  out.residual = Eigen::ArrayXXd::Zero(kPhaseBins, frames);
  out.tile_count = Eigen::ArrayXXd::Zero(kPhaseBins, kContrastTiles * kContrastTiles);
  out.tile_log_contrast = out.tile_count;
  out.tile_log_mean = out.tile_count;
  const GridSamples grid = sample_grid(stack, samples);

  // Mean, cosine and sine of each pixel.
  Eigen::MatrixX3d weights(frames, 3);
  weights << vector_of(fit.mean), vector_of(fit.cosine), vector_of(fit.sine);
  const Eigen::MatrixX3f fringes = grid.counts.matrix() * weights.cast<float>();
  const Eigen::ArrayXf modulations = fringes.rightCols<2>().rowwise().norm();
  const auto is_unsaturated = unsaturated(grid.counts, stack.white_level, noise);
  const auto is_modulated = [&](Eigen::Index i) {
    const double mean = fringes(i, 0);
    const double sigma = fit.noise_gain * std::sqrt(noise.variance(mean));
    return mean > 0.0 && sigma <= kMaxBinnedSigma * static_cast<double>(modulations(i));
  };
  ModulationLevels levels(std::max(1e-9, static_cast<double>(modulations.maxCoeff())));
  for (Eigen::Index i = 0; i < fringes.rows(); ++i) {
    if (is_modulated(i)) levels.add(static_cast<double>(modulations(i)), is_unsaturated(i));
  }
  std::vector<Eigen::Index> modulated;
  std::vector<float> contrasts;
  for (Eigen::Index i = 0; i < fringes.rows(); ++i) {
    const auto modulation = static_cast<double>(modulations(i));
    if (!is_unsaturated(i) || !is_modulated(i) || !levels.accepts(modulation)) continue;
    modulated.push_back(i);
    contrasts.push_back(std::log(modulations(i) / fringes(i, 0)));
  }
  if (modulated.empty()) return out;
  const double typical = median(contrasts);
  const Eigen::VectorXd shift_cosine = vector_of(shifts_rad).array().cos().matrix();
  const Eigen::VectorXd shift_sine = vector_of(shifts_rad).array().sin().matrix();
  for (std::size_t j = 0; j < modulated.size(); ++j) {
    const double log_contrast = contrasts[j];
    if (std::abs(log_contrast - typical) > kMaxLogContrast) continue;
    const Eigen::Index i = modulated[j];
    const double mean = fringes(i, 0);
    const double cosine = fringes(i, 1);
    const double sine = fringes(i, 2);
    const double modulation = std::hypot(cosine, sine);
    const double phase = std::atan2(sine, cosine);
    const int bin =
        std::clamp(static_cast<int>((phase + kPi) / kTwoPi * kPhaseBins), 0, kPhaseBins - 1);
    const double weight = modulation * modulation / noise.variance(mean);
    out.weight(bin) += weight;
    out.mean_over_modulation(bin) += weight * mean / modulation;
    for (Eigen::Index k = 0; k < frames; ++k) {
      const double model = mean + cosine * shift_cosine(k) - sine * shift_sine(k);
      out.residual(bin, k) +=
          weight * (static_cast<double>(grid.counts(i, k)) - model) / modulation;
    }
    out.tile_count(bin, grid.tile[static_cast<std::size_t>(i)]) += 1.0;
    out.tile_log_contrast(bin, grid.tile[static_cast<std::size_t>(i)]) += log_contrast;
    out.tile_log_mean(bin, grid.tile[static_cast<std::size_t>(i)]) += std::log(mean);
    ++out.pixels;
  }
  for (int bin = 0; bin < kPhaseBins; ++bin) {
    if (out.weight(bin) == 0.0) continue;
    out.residual.row(bin) /= out.weight(bin);
    out.mean_over_modulation(bin) /= out.weight(bin);
  }
  return out;
}

}  // namespace frangia
