#include "frangia/phase/estimate_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/LU>

#include "frangia/core/median.h"
#include "frangia/phase/internal/combined_harmonics.h"
#include "frangia/phase/phase_algorithm.h"

namespace frangia {
namespace {

constexpr int kBins = NoiseSamples::kBins;
constexpr double kMinSigma = 0.3;  ///< counts: quantization, 1 / sqrt(12)
constexpr std::size_t kMinSamples =
    200;  ///< fewest samples of a bin; the variance then has a standard error of 10 %
constexpr std::size_t kRowSamples = 400'000;  ///< approximate number of pixels sampled per stack

/// Three frames: their mean is preferred if its apparent variance is below this share of that of
/// the single frames. Without fine fringes and texture both are equal within a few percent.
constexpr double kFineFringes = 0.8;

using Bins = std::array<std::vector<float>, kBins>;

using Weights = std::vector<double>;

/// Each frame alone.
std::vector<Weights> single_frames(std::size_t count) {
  std::vector<Weights> combinations;
  for (std::size_t k = 0; k < count; ++k) {
    combinations.emplace_back(count, 0.0);
    combinations.back()[k] = 1.0;
  }
  return combinations;
}

/// The mean of the frames, in which the fringes cancel, with unit norm.
Weights mean_of_frames(const std::vector<double>& shifts_rad) {
  Weights mean = least_squares(shifts_rad).mean;
  double square = 0.0;
  for (const double weight : mean)
    square += weight * weight;
  for (double& weight : mean)
    weight /= std::sqrt(square);
  return mean;
}

/// The combination of four frames or more, of unit norm, that contains noise only.
Weights noise_combination(const std::vector<double>& shifts_rad) {
  const std::size_t count = shifts_rad.size();
  const PhaseAlgorithm fit = least_squares(shifts_rad);
  // The residual of one frame after the fit of mean, cosine and sine; the frame with the largest
  // residual is used.
  Weights best;
  double best_square = 0.0;
  for (std::size_t frame = 0; frame < count; ++frame) {
    Weights left(count);
    double square = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
      const double model = fit.mean[frame] + fit.cosine[frame] * std::cos(shifts_rad[k]) -
                           fit.sine[frame] * std::sin(shifts_rad[k]);
      left[k] = (k == frame ? 1.0 : 0.0) - model;
      square += left[k] * left[k];
    }
    if (square <= best_square) continue;
    best_square = square;
    best = left;
  }
  for (double& weight : best)
    weight /= std::sqrt(best_square);
  return best;
}

/// Absolute second differences along one row, binned by brightness.
void gather_row(const FrameStack& stack,
                const Weights& weights,
                const CombinedHarmonics& harmonics,
                int y,
                Bins& bins) {
  const int width = width_of(stack.frames.front());
  std::vector<double> sum(static_cast<std::size_t>(width), 0.0);
  std::vector<double> mean(sum);
  std::vector<int> brightest(sum.size(), 0);
  std::vector<int> darkest(sum.size(), stack.white_level);
  for (std::size_t k = 0; k < stack.frames.size(); ++k) {
    std::visit(
        [&](const auto& image) {
          for (int x = 0; x < width; ++x) {
            const auto i = static_cast<std::size_t>(x);
            sum[i] += weights[k] * image(x, y);
            mean[i] += image(x, y) / static_cast<double>(stack.frames.size());
            brightest[i] = std::max(brightest[i], static_cast<int>(image(x, y)));
            darkest[i] = std::min(darkest[i], static_cast<int>(image(x, y)));
          }
        },
        stack.frames[k]);
  }
  if (harmonics.found()) {
    for (int x = 0; x < width; ++x)
      sum[static_cast<std::size_t>(x)] -= harmonics.value_at(stack, x, y);
  }
  for (std::size_t i = 1; i + 1 < sum.size(); ++i) {
    if (std::max({brightest[i - 1], brightest[i], brightest[i + 1]}) >= stack.white_level) continue;
    // Clipping at 0 counts would reduce the apparent noise.
    if (std::min({darkest[i - 1], darkest[i], darkest[i + 1]}) <= 0) continue;
    const double difference = (sum[i - 1] - 2.0 * sum[i] + sum[i + 1]) / std::sqrt(6.0);
    const double share = mean[i] / stack.white_level;
    const auto bin = std::min<std::size_t>(kBins - 1, static_cast<std::size_t>(share * kBins));
    bins[bin].push_back(static_cast<float>(std::abs(difference)));
  }
}

/// Robust variance of Gaussian noise from absolute values: a median, refined by three rounds of
/// 3-sigma clipping because the median of whole counts moves in steps.
double robust_variance(std::vector<float> magnitudes) {
  double sigma = std::max(median_in_place(std::span(magnitudes)) / 0.6745, kMinSigma);
  for (int i = 0; i < 3; ++i) {
    double sum = 0.0;
    double count = 0.0;
    for (const float magnitude : magnitudes) {
      if (magnitude > 3.0 * sigma) continue;
      sum += static_cast<double>(magnitude) * magnitude;
      count += 1.0;
    }
    sigma = std::sqrt(sum / std::max(count, 1.0) /
                      0.9733);  // 0.9733: variance of a Gaussian truncated at 3 sigma
  }
  return sigma * sigma;
}

double pooled_variance(const Bins& bins) {
  std::vector<float> all;
  for (const std::vector<float>& bin : bins)
    all.insert(all.end(), bin.begin(), bin.end());
  return robust_variance(std::move(all));
}

}  // namespace

void NoiseSamples::add(const FrameStack& stack) {
  if (stack.pattern.kind != PatternKind::Fringe || stack.frames.size() < 3) return;
  white_ = stack.white_level;
  const int height = height_of(stack.frames.front());
  const int width = width_of(stack.frames.front());
  const int stride =
      std::max(1, static_cast<int>(static_cast<double>(width) * height / kRowSamples));
  const std::vector<double>& shifts = stack.pattern.shifts_rad;
  const auto gather = [&](const Weights& weights, Bins& bins) {
    const CombinedHarmonics harmonics(stack, weights);
    for (int y = stride / 2; y < height; y += stride)
      gather_row(stack, weights, harmonics, y, bins);
  };
  if (shifts.size() > 3) {
    gather(noise_combination(shifts), bins_);
    return;
  }
  // Fine fringes add to the apparent noise of single frames, texture to that of their mean.
  Bins single;
  Bins mean;
  for (const Weights& weights : single_frames(shifts.size()))
    gather(weights, single);
  gather(mean_of_frames(shifts), mean);
  const bool fine = pooled_variance(mean) < kFineFringes * pooled_variance(single);
  for (std::size_t bin = 0; bin < bins_.size(); ++bin) {
    const std::vector<float>& from = fine ? mean[bin] : single[bin];
    bins_[bin].insert(bins_[bin].end(), from.begin(), from.end());
  }
}

NoiseModel NoiseSamples::model() const {
  // Weighted straight line through the bins; the weight is samples / variance^2.
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (int bin = 0; bin < kBins; ++bin) {
    const auto& magnitudes = bins_[static_cast<std::size_t>(bin)];
    if (magnitudes.size() < kMinSamples) continue;
    const double variance = std::max(robust_variance(magnitudes), 1.0 / 12.0);
    const Eigen::Vector2d row(1.0, (bin + 0.5) * white_ / kBins);
    const double weight = static_cast<double>(magnitudes.size()) / (variance * variance);
    normal += weight * row * row.transpose();
    right += weight * row * variance;
  }
  NoiseModel model;
  if (normal(0, 0) == 0.0) return model;
  Eigen::Vector2d line(right(0) / normal(0, 0), 0.0);
  if (normal.determinant() > 1e-9 * normal(0, 0) * normal(1, 1)) line = normal.inverse() * right;
  if (line(1) < 0.0) line = {right(0) / normal(0, 0), 0.0};
  if (line(0) < model.floor_counts2) {
    line = {model.floor_counts2,
            std::max(0.0, (right(1) - model.floor_counts2 * normal(0, 1)) / normal(1, 1))};
  }
  model.floor_counts2 = line(0);
  model.slope_counts = line(1);
  return model;
}

NoiseModel estimate_noise(std::span<const FrameStack> stacks) {
  NoiseSamples samples;
  for (const FrameStack& stack : stacks)
    samples.add(stack);
  return samples.model();
}

}  // namespace frangia
