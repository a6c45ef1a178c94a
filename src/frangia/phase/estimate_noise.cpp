#include "frangia/phase/estimate_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include <Eigen/Dense>

namespace frangia {
namespace {

constexpr int kBins = 24;
constexpr std::size_t kEnough = 200;          ///< samples that make a bin's median trustworthy
constexpr std::size_t kRowSamples = 400'000;  ///< pixels looked at in a stack, about

using Bins = std::array<std::vector<float>, kBins>;

/// Combinations of the frames, of unit length, that hold noise only.
std::vector<Eigen::VectorXd> noise_combinations(const std::vector<double>& shifts_rad) {
  const auto count = static_cast<Eigen::Index>(shifts_rad.size());
  Eigen::MatrixXd model(count, 3);
  for (Eigen::Index k = 0; k < count; ++k) {
    const double shift = shifts_rad[static_cast<std::size_t>(k)];
    model.row(k) << 1.0, std::cos(shift), std::sin(shift);
  }
  std::vector<Eigen::VectorXd> combinations;
  if (count == 3) {
    for (Eigen::Index k = 0; k < count; ++k)
      combinations.emplace_back(Eigen::VectorXd::Unit(count, k));
    return combinations;
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(model, Eigen::ComputeFullU);
  combinations.emplace_back(svd.matrixU().col(count - 1));
  return combinations;
}

/// |second differences| along one row, each in the bin of its brightness.
void gather_row(const FrameStack& stack, const Eigen::VectorXd& weights, int y, Bins& bins) {
  const int width = width_of(stack.frames.front());
  std::vector<double> sum(static_cast<std::size_t>(width), 0.0);
  std::vector<double> mean(sum);
  std::vector<int> top(sum.size(), 0);
  std::vector<int> bottom(sum.size(), stack.white_level);
  for (std::size_t k = 0; k < stack.frames.size(); ++k) {
    std::visit(
        [&](const auto& image) {
          for (int x = 0; x < width; ++x) {
            const auto i = static_cast<std::size_t>(x);
            sum[i] += weights(static_cast<Eigen::Index>(k)) * image(x, y);
            mean[i] += image(x, y) / static_cast<double>(stack.frames.size());
            top[i] = std::max(top[i], static_cast<int>(image(x, y)));
            bottom[i] = std::min(bottom[i], static_cast<int>(image(x, y)));
          }
        },
        stack.frames[k]);
  }
  for (std::size_t i = 1; i + 1 < sum.size(); ++i) {
    if (std::max({top[i - 1], top[i], top[i + 1]}) >= stack.white_level) continue;
    // Cut off at black, noise looks smaller than it is.
    if (std::min({bottom[i - 1], bottom[i], bottom[i + 1]}) <= 0) continue;
    const double difference = (sum[i - 1] - 2.0 * sum[i] + sum[i + 1]) / std::sqrt(6.0);
    const double share = mean[i] / stack.white_level;
    const auto bin = std::min<std::size_t>(kBins - 1, static_cast<std::size_t>(share * kBins));
    bins[bin].push_back(static_cast<float>(std::abs(difference)));
  }
}

/// Variance of Gaussian noise from its absolute values, blind to the few that are no noise. A
/// median alone would move in steps where the counts are few.
double robust_variance(std::vector<float>& magnitudes) {
  const auto middle = magnitudes.begin() + static_cast<std::ptrdiff_t>(magnitudes.size() / 2);
  std::nth_element(magnitudes.begin(), middle, magnitudes.end());
  double sigma = std::max(*middle / 0.6745, 0.3);
  for (int i = 0; i < 3; ++i) {
    double sum = 0.0;
    double count = 0.0;
    for (const float magnitude : magnitudes) {
      if (magnitude > 3.0 * sigma) continue;
      sum += static_cast<double>(magnitude) * magnitude;
      count += 1.0;
    }
    sigma = std::sqrt(sum / std::max(count, 1.0) / 0.9733);  // what 3 sigmas cut off a Gaussian
  }
  return sigma * sigma;
}

}  // namespace

NoiseModel estimate_noise(std::span<const FrameStack> stacks) {
  Bins bins;
  int white = 255;
  for (const FrameStack& stack : stacks) {
    if (stack.pattern.kind != PatternKind::Fringe || stack.frames.size() < 3) continue;
    white = stack.white_level;
    const int height = height_of(stack.frames.front());
    const int width = width_of(stack.frames.front());
    const int stride =
        std::max(1, static_cast<int>(static_cast<double>(width) * height / kRowSamples));
    for (const Eigen::VectorXd& weights : noise_combinations(stack.pattern.shifts_rad)) {
      for (int y = stride / 2; y < height; y += stride)
        gather_row(stack, weights, y, bins);
    }
  }
  // Straight line through the bins, each weighted by its samples over its variance squared.
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (int bin = 0; bin < kBins; ++bin) {
    auto& magnitudes = bins[static_cast<std::size_t>(bin)];
    if (magnitudes.size() < kEnough) continue;
    const double variance = std::max(robust_variance(magnitudes), 1.0 / 12.0);
    const Eigen::Vector2d row(1.0, (bin + 0.5) * white / kBins);
    const double weight = static_cast<double>(magnitudes.size()) / (variance * variance);
    normal += weight * row * row.transpose();
    right += weight * row * variance;
  }
  NoiseModel model;
  if (normal(0, 0) == 0.0) return model;
  Eigen::Vector2d line(right(0) / normal(0, 0), 0.0);
  if (normal.determinant() > 1e-9 * normal(0, 0) * normal(1, 1)) line = normal.ldlt().solve(right);
  if (line(1) < 0.0) line = {right(0) / normal(0, 0), 0.0};
  if (line(0) < model.floor_counts2)
    line = {model.floor_counts2,
            std::max(0.0, (right(1) - model.floor_counts2 * normal(0, 1)) / normal(1, 1))};
  model.floor_counts2 = line(0);
  model.slope_counts = line(1);
  return model;
}

}  // namespace frangia
