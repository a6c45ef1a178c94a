#include "frangia/phase/wrap/estimate_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "frangia/core/statistics.h"
#include "frangia/phase/algorithm/phase_algorithm.h"
#include "frangia/phase/waveform/fit_waveform.h"
#include "frangia/phase/wrap/internal/fit_noise.h"
#include "frangia/phase/wrap/internal/row_rounds.h"

namespace frangia {
namespace {

/// Weights of the frames of a combination.
using FrameWeights = std::vector<double>;

/// The harmonics of the fringes of a stack.
class FringeHarmonics {
 public:
  /// Finds the harmonics; there are none for fewer than four frames.
  explicit FringeHarmonics(const FrameStack& stack)
      : fit_(least_squares(stack.pattern.shifts_rad)), shifts_(stack.pattern.shifts_rad) {
    if (shifts_.size() < 4) return;
    // The noise is not known yet; the scatter of the residuals decides.
    constexpr std::size_t kHarmonicSamples = 10'000;
    waveform_ =
        fit_waveform(
            stack, shifts_, NoiseModel{}, {.samples = kHarmonicSamples, .min_harmonic = 0.002})
            .waveform;
    for (const auto& harmonic : waveform_.harmonics)
      found_ = found_ || harmonic != 0.0;
  }
  [[nodiscard]] bool found() const { return found_; }
  /// Their value in a combination of the frames at a pixel, counts.
  [[nodiscard]] double value_at(const FrameStack& stack,
                                const FrameWeights& weights,
                                int x,
                                int y) const {
    double cosine = 0.0;
    double sine = 0.0;
    for (std::size_t k = 0; k < shifts_.size(); ++k) {
      const double counts = counts_at(stack.frames[k], x, y);
      cosine += fit_.cosine[k] * counts;
      sine += fit_.sine[k] * counts;
    }
    const double phase = std::atan2(sine, cosine);
    double value = 0.0;
    for (std::size_t k = 0; k < shifts_.size(); ++k)
      value += weights[k] * waveform_.light_at(phase + shifts_[k]);
    return std::hypot(cosine, sine) * value;
  }

 private:
  PhaseAlgorithm fit_;
  std::vector<double> shifts_;
  FringeWaveform waveform_;
  bool found_ = false;
};

/// Absolute differences, binned by brightness.
using NoiseBins = NoiseSamples::Bins;

/// Gathers the noise in rows of one combination of the frames.
class NoiseRowGatherer {
 public:
  /// `stack` and `harmonics` must outlive the gatherer; one weight a frame.
  NoiseRowGatherer(const FrameStack& stack,
                   const FringeHarmonics& harmonics,
                   FrameWeights weights,
                   int distance_px,
                   double range_counts)
      : stack_(&stack),
        harmonics_(&harmonics),
        weights_(std::move(weights)),
        distance_px_(static_cast<std::size_t>(distance_px)),
        range_counts_(range_counts) {}
  /// Adds the absolute second differences along a row.
  void gather(int y, NoiseBins& bins) const;

 private:
  const FrameStack* stack_;
  const FringeHarmonics* harmonics_;
  FrameWeights weights_;
  std::size_t distance_px_;
  double range_counts_;  ///< of all bins together
};

void NoiseRowGatherer::gather(int y, NoiseBins& bins) const {
  const int width = width_of(stack_->frames.front());
  std::vector<double> sum(static_cast<std::size_t>(width), 0.0);
  std::vector<double> mean(sum);
  std::vector<int> brightest(sum.size(), 0);
  std::vector<int> darkest(sum.size(), stack_->white_level);
  for (std::size_t k = 0; k < stack_->frames.size(); ++k) {
    std::visit(
        [&](const auto& image) {
          for (int x = 0; x < width; ++x) {
            const auto i = static_cast<std::size_t>(x);
            mean[i] += image(x, y) / static_cast<double>(stack_->frames.size());
            if (weights_[k] == 0.0) continue;
            sum[i] += weights_[k] * image(x, y);
            brightest[i] = std::max(brightest[i], static_cast<int>(image(x, y)));
            darkest[i] = std::min(darkest[i], static_cast<int>(image(x, y)));
          }
        },
        stack_->frames[k]);
  }
  if (harmonics_->found()) {
    for (int x = 0; x < width; ++x)
      sum[static_cast<std::size_t>(x)] -= harmonics_->value_at(*stack_, weights_, x, y);
  }
  const std::size_t d = distance_px_;
  for (std::size_t i = d; i + d < sum.size(); ++i) {
    if (std::max({brightest[i - d], brightest[i], brightest[i + d]}) >= stack_->white_level)
      continue;
    const bool cut_off = std::min({darkest[i - d], darkest[i], darkest[i + d]}) <= 0;
    const double difference = (sum[i - d] - 2.0 * sum[i] + sum[i + d]) / std::sqrt(6.0);
    const double share = mean[i] / range_counts_;
    auto number = std::min<std::size_t>(NoiseSamples::kBins - 1,
                                        static_cast<std::size_t>(share * NoiseSamples::kBins));
    // Fringes whose dark end is cut off bend there; the first bin is that of a dark background.
    constexpr double kDark = 3.0 / NoiseSamples::kBins;
    if (cut_off && brightest[i] > kDark * range_counts_) number = std::max<std::size_t>(number, 1);
    NoiseSamples::Bin& bin = (cut_off ? bins.cut_off : bins.lit)[number];
    bin.differences_counts.push_back(static_cast<float>(std::abs(difference)));
    bin.sum_counts += mean[i];
  }
}

constexpr double kMinSigma = 0.3;  ///< counts: quantization, 1 / sqrt(12)
constexpr std::size_t kMinBinSamples =
    200;  ///< fewest samples of a bin; the variance then has a standard error of 10 %
/// Pixels of a stack that are sampled in the first round; the variance of one bin of them has a
/// standard error of 1 %. More rounds follow until the bins are filled, up to the second number.
constexpr double kFirstSamples = 32'768;
constexpr double kMostSamples = 400'000;

/// Three frames: their mean is preferred if its apparent variance is below this share of that of
/// the single frames. Without fine fringes and texture both are equal within a few percent.
constexpr double kFineFringes = 0.8;

/// Each frame alone.
std::vector<FrameWeights> single_frames(std::size_t count) {
  std::vector<FrameWeights> combinations;
  for (std::size_t k = 0; k < count; ++k) {
    combinations.emplace_back(count, 0.0);
    combinations.back()[k] = 1.0;
  }
  return combinations;
}

/// The mean of the frames, in which the fringes cancel, with unit norm.
FrameWeights mean_of_frames(const std::vector<double>& shifts_rad) {
  FrameWeights mean = least_squares(shifts_rad).mean;
  double square = 0.0;
  for (const double weight : mean)
    square += weight * weight;
  for (double& weight : mean)
    weight /= std::sqrt(square);
  return mean;
}

/// Combinations of four frames or more, of unit norm, that contain noise only: the residual of each
/// frame after the fit of mean, cosine and sine. That of one frame has mostly its own noise, which
/// is small where coarse fringes are dark in it all over the part.
std::vector<FrameWeights> noise_combinations(const std::vector<double>& shifts_rad) {
  constexpr double kLeastResidual = 1e-6;  // of a frame that the fit always meets
  const std::size_t count = shifts_rad.size();
  const PhaseAlgorithm fit = least_squares(shifts_rad);
  std::vector<FrameWeights> combinations;
  for (std::size_t frame = 0; frame < count; ++frame) {
    FrameWeights left(count);
    double square = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
      const double model = fit.mean[frame] + fit.cosine[frame] * std::cos(shifts_rad[k]) -
                           fit.sine[frame] * std::sin(shifts_rad[k]);
      left[k] = (k == frame ? 1.0 : 0.0) - model;
      square += left[k] * left[k];
    }
    if (square < kLeastResidual) continue;
    for (double& weight : left)
      weight /= std::sqrt(square);
    combinations.push_back(std::move(left));
  }
  return combinations;
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

/// Whether nearly all samples outside of the fullest bin, the background's, lie in bins that are
/// full enough to be used. A small part needs more rows than a large one.
bool are_filled(const NoiseBins& bins) {
  constexpr double kFew = 0.1;
  constexpr double kStray = 1e-3;  // of all samples: a part that small fills no bin in any case
  double all = 0.0;
  double unused = 0.0;
  double fullest = 0.0;
  for (const NoiseSamples::Bin& bin : bins.lit) {
    const auto size = static_cast<double>(bin.differences_counts.size());
    all += size;
    unused += bin.differences_counts.size() < kMinBinSamples ? size : 0.0;
    fullest = std::max(fullest, size);
  }
  return fullest >= static_cast<double>(kMinBinSamples) &&
         unused <= std::max(kFew * (all - fullest), kStray * all);
}

void append(const NoiseSamples::Bin& from, NoiseSamples::Bin& to) {
  const std::vector<float>& added = from.differences_counts;
  to.differences_counts.insert(to.differences_counts.end(), added.begin(), added.end());
  to.sum_counts += from.sum_counts;
}

void append(const NoiseBins& from, NoiseBins& to) {
  for (std::size_t bin = 0; bin < to.lit.size(); ++bin) {
    append(from.lit[bin], to.lit[bin]);
    append(from.cut_off[bin], to.cut_off[bin]);
  }
}

/// The white level, or a half, a quarter and so on of it that no pixel below it exceeds, so that
/// the bins of brightness are those that occur; not below 8 bits.
double range_of(const FrameStack& stack) {
  constexpr int kStride = 5;
  constexpr double kEightBits = 255.0;
  int brightest = 0;
  for (const Frame& frame : stack.frames) {
    std::visit(
        [&](const auto& image) {
          for (int y = kStride / 2; y < image.height(); y += kStride) {
            for (int x = kStride / 2; x < image.width(); x += kStride) {
              const int counts = image(x, y);
              if (counts < stack.white_level) brightest = std::max(brightest, counts);
            }
          }
        },
        frame);
  }
  double range = stack.white_level;
  while (0.5 * range > brightest && 0.5 * range >= kEightBits)
    range *= 0.5;
  return range;
}

/// The mean over the samples of the variances of their bins. A median over all of them would be
/// that of the background, which shows neither fringes nor texture.
double mean_variance(const NoiseBins& bins) {
  double sum = 0.0;
  double count = 0.0;
  for (const NoiseSamples::Bin& bin : bins.lit) {
    if (bin.differences_counts.size() < kMinBinSamples) continue;
    const auto size = static_cast<double>(bin.differences_counts.size());
    sum += size * robust_variance(bin.differences_counts);
    count += size;
  }
  return sum / std::max(count, 1.0);
}

}  // namespace

void NoiseSamples::add(const FrameStack& stack) {
  if (stack.pattern.kind != PatternKind::Fringe || stack.frames.size() < 3) return;
  white_ = stack.white_level;
  widen(range_of(stack));
  const std::vector<double>& shifts = stack.pattern.shifts_rad;
  const RowRounds rounds(
      width_of(stack.frames.front()), height_of(stack.frames.front()), kFirstSamples, kMostSamples);
  const FringeHarmonics harmonics(stack);
  if (shifts.size() > 3) {
    std::vector<NoiseRowGatherer> frames;
    for (const FrameWeights& weights : noise_combinations(shifts))
      frames.emplace_back(stack, harmonics, weights, distance_px_, range_counts_);
    NoiseBins bins;
    std::size_t rows = 0;
    for (int round = 0; round < rounds.count() && !are_filled(bins); ++round)
      rounds.for_each_row(round, [&](int y) { frames[rows++ % frames.size()].gather(y, bins); });
    append(bins, bins_);
    return;
  }
  // Fine fringes add to the apparent noise of single frames, texture to that of their mean.
  std::vector<NoiseRowGatherer> frames;
  for (const FrameWeights& weights : single_frames(shifts.size()))
    frames.emplace_back(stack, harmonics, weights, distance_px_, range_counts_);
  const NoiseRowGatherer mean_frame(
      stack, harmonics, mean_of_frames(shifts), distance_px_, range_counts_);
  NoiseBins single;
  NoiseBins mean;
  for (int round = 0; round < rounds.count() && !are_filled(mean); ++round) {
    rounds.for_each_row(round, [&](int y) {
      for (const NoiseRowGatherer& frame : frames)
        frame.gather(y, single);
      mean_frame.gather(y, mean);
    });
  }
  const double of_mean = mean_variance(mean);  // 0 where each pixel is cut off in some frame
  const bool is_less = of_mean > 0.0 && of_mean < kFineFringes * mean_variance(single);
  append(is_less ? mean : single, bins_);
}

void NoiseSamples::add(const NoiseSamples& other) {
  white_ = other.white_;
  if (other.range_counts_ == 0.0) return;
  widen(other.range_counts_);
  NoiseSamples wide = other;
  wide.widen(range_counts_);
  append(wide.bins_, bins_);
}

void NoiseSamples::widen(double range_counts) {
  if (range_counts <= range_counts_) return;
  const double factor = range_counts / std::exchange(range_counts_, range_counts);
  if (!std::isfinite(factor)) return;  // the first frames
  const Bins before = std::exchange(bins_, {});
  for (std::size_t bin = 0; bin < before.lit.size(); ++bin) {
    const auto wide = static_cast<std::size_t>(static_cast<double>(bin) / factor);
    append(before.lit[bin], bins_.lit[wide]);
    append(before.cut_off[bin], bins_.cut_off[wide]);
  }
}

bool NoiseSamples::empty() const {
  const auto is_few = [](const Bin& bin) { return bin.differences_counts.size() < kMinBinSamples; };
  return std::all_of(bins_.lit.begin(), bins_.lit.end(), is_few) &&
         std::all_of(bins_.cut_off.begin() + 1, bins_.cut_off.end(), is_few);
}

NoiseModel NoiseSamples::model() const {
  const auto variance_of = [](const Bin& bin) -> std::optional<phase::VarianceAt> {
    if (bin.differences_counts.size() < kMinBinSamples) return std::nullopt;
    const auto size = static_cast<double>(bin.differences_counts.size());
    return phase::VarianceAt{
        bin.sum_counts / size, std::max(robust_variance(bin.differences_counts), 1.0 / 12.0), size};
  };
  std::vector<phase::VarianceAt> variances;
  for (const Bin& bin : bins_.lit)
    if (const auto one = variance_of(bin)) variances.push_back(*one);
  if (variances.empty()) {
    for (std::size_t bin = 1; bin < bins_.cut_off.size(); ++bin)  // without the background
      if (const auto one = variance_of(bins_.cut_off[bin])) variances.push_back(*one);
    return phase::fit_noise(variances, {}, white_);
  }
  return phase::fit_noise(variances, variance_of(bins_.cut_off.front()), white_);
}

NoiseModel estimate_noise(std::span<const FrameStack> stacks) {
  NoiseSamples samples;
  for (const FrameStack& stack : stacks)
    samples.add(stack);
  return samples.model();
}

}  // namespace frangia
