#include "frangia/phase/waveform/cut_dark_end.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <variant>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>

#include "frangia/core/parallel.h"
#include "frangia/core/statistics.h"
#include "frangia/phase/internal/fringe_curve.h"

namespace frangia {
namespace {

constexpr std::size_t kCutPixels = 20'000;  ///< of an image that are looked at, about
constexpr double kFringeSigmas = 8.0;       ///< least change of a pixel with fringes
constexpr double kLeastShare = 0.01;        ///< of the samples; fewer do not matter
constexpr double kOverSteps = 4.0;          ///< samples at the level over those of a step above
constexpr int kSteps = 12;                  ///< of the noise that are compared
constexpr double kSureSigmas = 3.0;
constexpr double kMinPivot = 1e-3;  ///< of a normal matrix, over the largest
constexpr double kLeastScatter = 0.02;
constexpr std::size_t kFewest = 200;  ///< pixels that say something

/// The mean of fringes as a function of their modulation.
struct MeanOfModulation {
  double slope = 0.0;
  double offset = 0.0;
  double scatter = 0.0;  ///< over the modulation; 0: not known
};

/// A fringe through the samples of a pixel above a level.
struct CensoredFringe {
  bool is_determined = false;
  Eigen::Vector3d values = Eigen::Vector3d::Zero();  ///< mean, cosine and sine
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();

  [[nodiscard]] double phase_variance() const {
    const double square = values.tail<2>().squaredNorm();
    const Eigen::Vector3d slope(0.0, -values(2) / square, values(1) / square);
    return slope.dot(covariance * slope);
  }
};

class CensoredFit {
 public:
  CensoredFit(const std::vector<double>& shifts_rad, int level) : level_(level) {
    for (const double shift : shifts_rad)
      rows_.push_back(fringe_model_row(shift));
    of_all_ = fringe_normal_matrix(shifts_rad).inverse();
  }
  [[nodiscard]] const std::vector<Eigen::Vector3d>& rows() const { return rows_; }

  [[nodiscard]] CensoredFringe fit(const std::vector<int>& counts,
                                   double variance,
                                   const MeanOfModulation& mean) const {
    constexpr int kRounds = 6;
    CensoredFringe out;
    const bool has_mean = mean.scatter > 0.0;
    const auto above =
        std::count_if(counts.begin(), counts.end(), [&](int c) { return c > level_; });
    if (above < (has_mean ? 2 : 3)) return out;
    Eigen::Vector3d of_counts = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < counts.size(); ++k)
      of_counts += counts[k] * rows_[k];
    out.values = of_all_ * of_counts;
    for (int round = 0; round < kRounds; ++round) {
      Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
      Eigen::Vector3d right = Eigen::Vector3d::Zero();
      for (std::size_t k = 0; k < counts.size(); ++k) {
        if (counts[k] <= level_ && (round == 0 || rows_[k].dot(out.values) <= level_)) continue;
        normal += rows_[k] * rows_[k].transpose();
        right += counts[k] * rows_[k];
      }
      if (has_mean) {  // A - slope B = offset, within its scatter
        const double modulation = std::max(1e-3, out.values.tail<2>().norm());
        const Eigen::Vector3d row(1.0,
                                  -mean.slope * out.values(1) / modulation,
                                  -mean.slope * out.values(2) / modulation);
        const double weight = variance / std::pow(mean.scatter * modulation, 2);
        normal += weight * row * row.transpose();
        right += weight * mean.offset * row;
      }
      const Eigen::LDLT<Eigen::Matrix3d> factors(normal);
      const Eigen::Vector3d pivots = factors.vectorD();
      if (!(pivots.minCoeff() > kMinPivot * pivots.maxCoeff())) return out;
      const Eigen::Vector3d before = std::exchange(out.values, factors.solve(right));
      constexpr double kSettled = 1e-3;  // counts
      if (round + 1 < kRounds && (out.values - before).norm() > kSettled) continue;
      out.covariance = variance * factors.solve(Eigen::Matrix3d::Identity());
      break;
    }
    out.is_determined = out.values.tail<2>().squaredNorm() > 0.0;
    return out;
  }

  /// Its standard deviation over that of the phase through all samples.
  [[nodiscard]] float noise_gain(const CensoredFringe& found, double variance) const {
    CensoredFringe all = found;
    all.covariance = variance * of_all_;
    return static_cast<float>(
        std::sqrt(std::max(1.0, found.phase_variance() / all.phase_variance())));
  }

 private:
  int level_;
  std::vector<Eigen::Vector3d> rows_;
  Eigen::Matrix3d of_all_;
};

/// Whether the light of a pixel changes over the frames as fringes do, and how noisy it is.
struct PixelLight {
  bool has_fringes = false;
  double variance = 0.0;
};

PixelLight light_of(const std::vector<int>& counts, int white_level, const NoiseModel& noise) {
  const auto [least, most] = std::minmax_element(counts.begin(), counts.end());
  double mean = 0.0;
  for (const int one : counts)
    mean += static_cast<double>(one) / static_cast<double>(counts.size());
  const double variance = noise.variance(mean);
  const int change = *most - *least;
  return {*most < white_level && change > kFringeSigmas * std::sqrt(variance), variance};
}

void read_pixel(const FrameStack& stack, int x, int y, std::vector<int>& counts) {
  for (std::size_t k = 0; k < counts.size(); ++k)
    counts[k] = counts_at(stack.frames[k], x, y);
}

/// Sampled pixels with fringes of one pattern.
struct CutSamples {
  const FrameStack* stack = nullptr;
  std::vector<std::vector<int>> counts;
  std::vector<double> variances;
};

bool may_be_cut(const FrameStack& stack) {
  return stack.pattern.kind == PatternKind::Fringe && stack.frames.size() >= 3 &&
         stack.frames.size() == stack.pattern.shifts_rad.size();
}

CutSamples sample_fringes(const FrameStack& stack, const NoiseModel& noise) {
  CutSamples out{&stack, {}, {}};
  const int width = width_of(stack.frames.front());
  const int height = height_of(stack.frames.front());
  const int stride = std::max(
      1, static_cast<int>(std::sqrt(static_cast<double>(width) * height / double{kCutPixels})));
  std::vector<int> counts(stack.frames.size());
  for (int y = stride / 2; y < height; y += stride) {
    for (int x = stride / 2; x < width; x += stride) {
      read_pixel(stack, x, y, counts);
      const PixelLight light = light_of(counts, stack.white_level, noise);
      if (!light.has_fringes) continue;
      out.counts.push_back(counts);
      out.variances.push_back(light.variance);
    }
  }
  return out;
}

/// The lowest level at which four times as many samples lie as in any step of the noise above it.
std::optional<CutDarkEnd> find_pile(const std::vector<CutSamples>& samples,
                                    const NoiseModel& noise) {
  constexpr double kStray = 0.002;  // of the samples: dead pixels
  std::map<int, double> levels;
  double all = 0.0;
  for (const CutSamples& one : samples) {
    for (const std::vector<int>& counts : one.counts) {
      for (const int count : counts)
        levels[count] += 1.0;
      all += static_cast<double>(counts.size());
    }
  }
  double stray = 0.0;
  auto lowest = levels.begin();
  for (; lowest != levels.end() && lowest->second < kStray * all; ++lowest)
    stray += lowest->second;
  if (lowest == levels.end() || stray > kStray * all) return std::nullopt;
  const int level = lowest->first;
  const int step = std::max(1, static_cast<int>(std::lround(std::sqrt(noise.variance(level)))));
  std::vector<double> steps(kSteps + 1, 0.0);
  for (auto one = lowest; one != levels.end(); ++one) {
    const int number = (one->first - level) / step;
    if (number <= kSteps) steps[static_cast<std::size_t>(number)] += one->second;
  }
  const double most = std::max(1.0, *std::max_element(steps.begin() + 1, steps.end()));
  if (steps.front() < kLeastShare * all || steps.front() < kOverSteps * most) return std::nullopt;
  return CutDarkEnd{.counts = level, .share = lowest->second / all};
}

/// The line of the mean over the modulation, of pixels that are determined without it.
MeanOfModulation mean_of_modulation(const std::vector<CutSamples>& samples, int level) {
  constexpr int kRounds = 5;
  std::vector<Eigen::Vector2d> known;  // modulation and mean
  for (const CutSamples& one : samples) {
    const CensoredFit fit(one.stack->pattern.shifts_rad, level);
    for (std::size_t i = 0; i < one.counts.size(); ++i) {
      const CensoredFringe found = fit.fit(one.counts[i], one.variances[i], {});
      if (found.is_determined) known.emplace_back(found.values.tail<2>().norm(), found.values(0));
    }
  }
  MeanOfModulation out;
  if (known.size() < kFewest) return out;
  std::vector<double> weights(known.size(), 1.0);
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    for (std::size_t i = 0; i < known.size(); ++i) {
      const Eigen::Vector2d row(known[i](0), 1.0);
      const double weight = weights[i] / (known[i](0) * known[i](0));
      normal += weight * row * row.transpose();
      right += weight * known[i](1) * row;
    }
    // One modulation all over the part says nothing about the offset.
    normal(1, 1) += 1e-6 * normal(1, 1);
    const Eigen::Vector2d line = normal.ldlt().solve(right);
    std::vector<double> off;
    for (const Eigen::Vector2d& one : known)
      off.push_back(std::abs(one(1) - line(0) * one(0) - line(1)) / one(0));
    const double sigma = std::max(kLeastScatter, median(off) / kMedianOfNormal);
    for (std::size_t i = 0; i < known.size(); ++i)
      weights[i] = 1.0 / std::max(1.0, std::pow(off[i] / (2.0 * sigma), 2));
    out = {line(0), line(1), sigma};
  }
  return out;
}

/// What the samples above a level say of those at it.
struct Predicted {
  std::vector<double> depths;  ///< how far below the level each is predicted, counts
  std::size_t below = 0;       ///< by more than three standard deviations
  std::size_t above = 0;       ///< the same above the level
  std::vector<double> rests;   ///< squared residuals of those above, over their expectation
};

void predict(const CutSamples& samples,
             const CutDarkEnd& cut,
             const MeanOfModulation& mean,
             Predicted& out) {
  const CensoredFit fit(samples.stack->pattern.shifts_rad, cut.counts);
  for (std::size_t i = 0; i < samples.counts.size(); ++i) {
    const std::vector<int>& counts = samples.counts[i];
    const double variance = samples.variances[i];
    const CensoredFringe free = fit.fit(counts, variance, {});
    double square = 0.0;
    double freedom = -3.0;
    for (std::size_t k = 0; k < counts.size() && free.is_determined; ++k) {
      if (counts[k] <= cut.counts) continue;
      square += std::pow(counts[k] - fit.rows()[k].dot(free.values), 2);
      freedom += 1.0;
    }
    if (freedom > 0.0) out.rests.push_back(square / (freedom * variance));
    if (*std::min_element(counts.begin(), counts.end()) > cut.counts) continue;
    const CensoredFringe found = free.is_determined ? free : fit.fit(counts, variance, mean);
    if (!found.is_determined) continue;
    for (std::size_t k = 0; k < counts.size(); ++k) {
      if (counts[k] > cut.counts) continue;
      const Eigen::Vector3d& row = fit.rows()[k];
      const double sigma = std::sqrt(variance + row.dot(found.covariance * row));
      const double depth = cut.counts - row.dot(found.values);
      out.depths.push_back(depth);
      if (depth > kSureSigmas * sigma) ++out.below;
      if (depth < -kSureSigmas * sigma) ++out.above;
    }
  }
}

double quantile_of(std::vector<double>& values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

Image<std::uint16_t> raised(const Frame& frame, int counts) {
  return std::visit(
      [&](const auto& image) {
        Image<std::uint16_t> out(image.width(), image.height(), Uninitialized{});
        std::transform(
            image.pixels().begin(), image.pixels().end(), out.pixels().begin(), [&](auto one) {
              return static_cast<std::uint16_t>(
                  std::min<int>(one + counts, std::numeric_limits<std::uint16_t>::max()));
            });
        return out;
      },
      frame);
}

/// The same noise at counts that are higher.
NoiseModel raised(const NoiseModel& noise, int counts) {
  NoiseModel out = noise;
  out.floor_counts2 =
      std::max(NoiseModel{}.floor_counts2, noise.floor_counts2 - noise.slope_counts * counts);
  if (noise.dark_counts2 == 0.0) return out;
  out.dark_range_counts = noise.dark_range_counts - counts;
  if (out.dark_range_counts > 0.0) {
    out.dark_counts2 *= std::pow(noise.dark_range_counts / out.dark_range_counts, 2);
  } else {
    out.dark_range_counts = 1.0;
    out.dark_counts2 = 0.0;
  }
  return out;
}

/// Fills the samples of a stack that are cut off into its raised frames.
void fill(const FrameStack& captured,
          const CutDarkEnd& cut,
          int raise,
          const NoiseModel& noise,
          FrameStack& out) {
  const CensoredFit fit(captured.pattern.shifts_rad, cut.counts);
  const MeanOfModulation mean{cut.slope, cut.offset_counts, cut.scatter};
  const int width = width_of(captured.frames.front());
  const int height = height_of(captured.frames.front());
  out.noise_gain = Image<float>(width, height, 1.0F);
  std::vector<Image<std::uint16_t>*> images;
  for (Frame& frame : out.frames)
    images.push_back(&std::get<Image<std::uint16_t>>(frame));
  parallel_rows(height, [&](int y) {
    std::vector<int> counts(captured.frames.size());
    for (int x = 0; x < width; ++x) {
      read_pixel(captured, x, y, counts);
      if (*std::min_element(counts.begin(), counts.end()) > cut.counts) continue;
      const PixelLight light = light_of(counts, captured.white_level, noise);
      if (!light.has_fringes) continue;
      const CensoredFringe found = fit.fit(counts, light.variance, mean);
      if (!found.is_determined) {
        out.noise_gain(x, y) = std::numeric_limits<float>::infinity();
        continue;
      }
      out.noise_gain(x, y) = fit.noise_gain(found, light.variance);
      for (std::size_t k = 0; k < counts.size(); ++k) {
        if (counts[k] > cut.counts) continue;
        const double predicted = std::min<double>(cut.counts, fit.rows()[k].dot(found.values));
        (*images[k])(x, y) =
            static_cast<std::uint16_t>(std::lround(std::max(0.0, predicted + raise)));
      }
    }
  });
}

}  // namespace

std::optional<CutDarkEnd> find_cut_dark_end(std::span<const FrameStack> stacks,
                                            const NoiseModel& noise) {
  constexpr double kMostAbove = 0.02;  // of the predicted samples: depth edges
  constexpr double kLeastBelow = 0.05;
  constexpr double kMostRest = 6.0;  // the median over its expectation: no sines
  std::vector<CutSamples> samples;
  for (const FrameStack& stack : stacks) {
    if (stack.pattern.exposure_count() > 1) return std::nullopt;
    if (may_be_cut(stack)) samples.push_back(sample_fringes(stack, noise));
  }
  std::optional<CutDarkEnd> out = find_pile(samples, noise);
  if (!out) return std::nullopt;
  const MeanOfModulation mean = mean_of_modulation(samples, out->counts);
  Predicted predicted;
  for (const CutSamples& one : samples)
    predict(one, *out, mean, predicted);
  const auto count = static_cast<double>(predicted.depths.size());
  if (predicted.depths.size() < kFewest ||
      static_cast<double>(predicted.below) < kLeastBelow * count ||
      static_cast<double>(predicted.above) > kMostAbove * count)
    return std::nullopt;
  if (predicted.rests.size() >= kFewest && median(predicted.rests) > kMostRest) return std::nullopt;
  out->depth_counts = quantile_of(predicted.depths, 0.95);
  out->least_counts = quantile_of(predicted.depths, 0.995);
  out->slope = mean.slope;
  out->offset_counts = mean.offset;
  out->scatter = mean.scatter;
  return out;
}

RaisedFrames raise_dark_end(std::span<const FrameStack> stacks,
                            const CutDarkEnd& cut,
                            const NoiseModel& noise) {
  constexpr double kMargin = 1.25;
  const int raise = static_cast<int>(std::ceil(kMargin * cut.least_counts)) + 1;
  RaisedFrames out{{}, raised(noise, raise)};
  for (const FrameStack& stack : stacks) {
    FrameStack& made = out.stacks.emplace_back(stack);
    for (Frame& frame : made.frames)
      frame = raised(frame, raise);
    made.white_level =
        std::min<int>(stack.white_level + raise, std::numeric_limits<std::uint16_t>::max());
    if (may_be_cut(stack)) fill(stack, cut, raise, noise, made);
  }
  return out;
}

}  // namespace frangia
