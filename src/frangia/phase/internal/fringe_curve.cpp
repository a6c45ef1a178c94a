#include "frangia/phase/internal/fringe_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/core/statistics.h"
#include "frangia/core/vectorized.h"
#include "frangia/phase/algorithm/phase_algorithm.h"
#include "frangia/phase/internal/unwrap_level_lanes.h"

namespace frangia {
namespace {

/// Adds the residuals of one map in all orders of the finest one.
FRANGIA_VECTORIZED void add_residuals(float phase_rad,
                                      float ratio,
                                      std::size_t orders,
                                      const float* __restrict absolute,
                                      float* __restrict square,
                                      float* __restrict along) {
  for (std::size_t i = 0; i < orders; ++i) {
    const float residual = wrap_lane(phase_rad - ratio * absolute[i]);
    square[i] += residual * residual;
    along[i] += residual * ratio;
  }
}

}  // namespace

FringeCurve::FringeCurve(std::vector<double> per_unit, double first, double last)
    : per_unit_(std::move(per_unit)), first_(first), last_(last) {
  require(!per_unit_.empty(), "FringeCurve: no map is given");
  finest_ = static_cast<std::size_t>(std::max_element(per_unit_.begin(), per_unit_.end()) -
                                     per_unit_.begin());
  for (const double frequency : per_unit_) {
    const double ratio = frequency / per_unit_[finest_];
    slope_weight_ += ratio * ratio;
  }
}

FringeCurve::Nearest FringeCurve::nearest(std::span<const float> phases_rad) {
  const double top = per_unit_[finest_];
  const double wrapped = phases_rad[finest_];
  // One order beyond each end, so that noise at the ends of the field costs little.
  const double lowest = std::ceil(top * first_ - wrapped / kTwoPi - 0.5);
  const double highest = std::floor(top * last_ - wrapped / kTwoPi + 0.5);
  const auto orders = static_cast<std::size_t>(std::max(0.0, highest - lowest) + 1.0);
  absolute_.resize(orders);
  along_.assign(orders, 0.0F);
  square_.resize(orders);
  const double low_rad = kTwoPi * top * first_;
  const double high_rad = kTwoPi * top * last_;
  for (std::size_t i = 0; i < orders; ++i) {
    const double at = wrapped + kTwoPi * (lowest + static_cast<double>(i));
    const double outside = std::max({low_rad - at, at - high_rad, 0.0});
    absolute_[i] = static_cast<float>(at);
    square_[i] = static_cast<float>(outside * outside);
  }
  for (std::size_t m = 0; m < per_unit_.size(); ++m) {
    if (m == finest_) continue;  // its residual is 0 in every order
    add_residuals(phases_rad[m],
                  static_cast<float>(per_unit_[m] / top),
                  orders,
                  absolute_.data(),
                  square_.data(),
                  along_.data());
  }
  Nearest out{std::numeric_limits<float>::max(), 0.0F};
  for (std::size_t i = 0; i < orders; ++i) {
    const auto shift = static_cast<float>(along_[i] / slope_weight_);  // along the curve
    const float found = square_[i] - along_[i] * shift;
    if (found >= out.distance_rad) continue;
    out.distance_rad = found;
    out.unit = static_cast<float>((absolute_[i] + shift) / (kTwoPi * top));
  }
  out.distance_rad = std::sqrt(std::max(0.0F, out.distance_rad));
  return out;
}

namespace {

/// Least ratio of eigenvalues of the normal matrix. At 1e-6 the noise is amplified a thousandfold.
constexpr double kMinEigenvalueRatio = 1e-6;

}  // namespace

Eigen::Vector3d fringe_model_row(double shift_rad) {
  return {1.0, std::cos(shift_rad), -std::sin(shift_rad)};
}

Eigen::Matrix3d fringe_normal_matrix(const std::vector<double>& shifts_rad) {
  if (shifts_rad.size() < 3) {
    throw Error(
        ErrorKind::Input,
        fmt::format("a phase needs at least 3 shifts, but the pattern has {}", shifts_rad.size()));
  }
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  for (const double shift : shifts_rad)
    normal += fringe_model_row(shift) * fringe_model_row(shift).transpose();
  const Eigen::Vector3d eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>().computeDirect(normal).eigenvalues();
  if (!(eigenvalues(0) > kMinEigenvalueRatio * eigenvalues(2))) {
    throw Error(ErrorKind::Input,
                "shifts_deg does not determine a phase: at least three shifts must differ, modulo "
                "360 degrees");
  }
  return normal;
}

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
                       std::size_t samples,
                       const PhaseAlgorithm& algorithm) {
  const Eigen::Index frames = std::ssize(shifts_rad);
  FringeBins out;
  out.residual = Eigen::ArrayXXd::Zero(kPhaseBins, frames);
  out.tile_count = Eigen::ArrayXXd::Zero(kPhaseBins, kContrastTiles * kContrastTiles);
  out.tile_log_contrast = out.tile_count;
  out.tile_log_mean = out.tile_count;
  const GridSamples grid = sample_grid(stack, samples);

  const auto mean_cosine_sine = [&](const PhaseAlgorithm& by) -> Eigen::MatrixX3f {
    Eigen::MatrixX3d weights(frames, 3);
    weights << vector_of(by.mean), vector_of(by.cosine), vector_of(by.sine);
    return grid.counts.matrix() * weights.cast<float>();
  };
  const Eigen::MatrixX3f fringes = mean_cosine_sine(algorithm);
  const Eigen::MatrixX3f fitted = mean_cosine_sine(least_squares(shifts_rad));
  const Eigen::ArrayXf modulations = fringes.rightCols<2>().rowwise().norm();
  const auto is_unsaturated = unsaturated(grid.counts, stack.white_level, noise);
  const auto is_modulated = [&](Eigen::Index i) {
    const double mean = fringes(i, 0);
    const double sigma = algorithm.noise_gain * std::sqrt(noise.variance(mean));
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
    const Eigen::Vector3d fringe = fitted.row(i).cast<double>();
    for (Eigen::Index k = 0; k < frames; ++k) {
      const double model = fringe(0) + fringe(1) * shift_cosine(k) - fringe(2) * shift_sine(k);
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
