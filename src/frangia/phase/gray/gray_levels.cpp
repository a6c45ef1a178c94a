// Brightness and noise of the frames of a Gray code.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "frangia/core/missing.h"
#include "frangia/core/parallel.h"
#include "frangia/core/statistics.h"
#include "frangia/pattern/gray_code.h"
#include "frangia/phase/gray/decode_gray_alone.h"

namespace frangia {
namespace {

/// Differences with the variance of one pixel, and its brightness.
struct GrayNoiseSample {
  float mean_counts;
  float difference;  ///< absolute
};

/// A number between -0.5 and 0.5, evenly distributed, which makes whole counts continuous: their
/// median would otherwise be a whole number.
float dither(std::size_t i) {
  constexpr double kGolden = 0.6180339887498949;
  const double turns = kGolden * static_cast<double>(i);
  return static_cast<float>(turns - std::floor(turns) - 0.5);
}

/// A frame and its inverse sum up to white and black, whatever the bit is.
void add_pair_samples(const FrameStack& gray, int x, int y, std::vector<GrayNoiseSample>& samples) {
  const auto sum_of = [&](int bit) {
    return counts_at(gray.frames[static_cast<std::size_t>(frame_of_bit(gray.pattern, bit, false))],
                     x,
                     y) +
           counts_at(
               gray.frames[static_cast<std::size_t>(frame_of_bit(gray.pattern, bit, true))], x, y);
  };
  for (int bit = 0; bit + 1 < gray.pattern.bits; bit += 2) {
    const int a = sum_of(bit);
    const int b = sum_of(bit + 1);
    samples.push_back({0.25F * static_cast<float>(a + b),
                       0.5F * std::abs(static_cast<float>(a - b) + dither(samples.size()))});
  }
}

void add_row_samples(const FrameStack& gray, int x, int y, std::vector<GrayNoiseSample>& samples) {
  if (x == 0 || x + 1 == width_of(gray.frames.front())) return;
  // The widest stripes, which have few borders.
  for (int bit = 0; 2 * bit < gray.pattern.bits; ++bit) {
    const Frame& frame =
        gray.frames[static_cast<std::size_t>(frame_of_bit(gray.pattern, bit, false))];
    const int counts = counts_at(frame, x, y);
    const int second = counts_at(frame, x - 1, y) - 2 * counts + counts_at(frame, x + 1, y);
    samples.push_back(
        {static_cast<float>(counts),
         std::abs(static_cast<float>(second) + dither(samples.size())) / std::sqrt(6.0F)});
  }
}

/// Variance of normal deviates from their absolute values.
double variance_of_grays(const std::vector<GrayNoiseSample>& samples) {
  std::vector<double> squares;
  for (const GrayNoiseSample& sample : samples)
    squares.push_back(static_cast<double>(sample.difference));
  return std::pow(median(std::move(squares)) / kMedianOfNormal, 2);
}

double mean_brightness(const std::vector<GrayNoiseSample>& samples) {
  double sum = 0.0;
  for (const GrayNoiseSample& sample : samples)
    sum += static_cast<double>(sample.mean_counts);
  return sum / static_cast<double>(samples.size());
}

}  // namespace

Image<float> gray_threshold(const FrameStack& gray,
                            const FrameStack* white,
                            const FrameStack* ambient) {
  const Frame& like = gray.frames.front();
  const int width = width_of(like);
  const int height = height_of(like);
  Image<float> threshold(width, height, Uninitialized{});
  const bool given =
      white != nullptr && ambient != nullptr && white->color.empty() && ambient->color.empty();
  Image<float> contrast(width, height, Uninitialized{});
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      int least = counts_at(given ? ambient->frames.front() : like, x, y);
      int most = counts_at(given ? white->frames.front() : like, x, y);
      for (const Frame& frame : gray.frames) {
        if (given) break;
        const int counts = counts_at(frame, x, y);
        least = std::min(least, counts);
        most = std::max(most, counts);
      }
      threshold(x, y) = 0.5F * static_cast<float>(least + most);
      contrast(x, y) = static_cast<float>(most - least);
    }
  });
  if (given) return threshold;
  // At a border where many bits change, no frame may be fully bright; the neighbouring pixels are.
  constexpr float kLeastOfBeside = 0.7F;
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      float beside = 0.0F;
      for (int row = std::max(y - 1, 0); row <= std::min(y + 1, height - 1); ++row) {
        for (int column = std::max(x - 1, 0); column <= std::min(x + 1, width - 1); ++column)
          beside = std::max(beside, contrast(column, row));
      }
      if (contrast(x, y) < kLeastOfBeside * beside) threshold(x, y) = kMissing;
    }
  });
  return threshold;
}

NoiseModel estimate_gray_noise(const FrameStack& gray) {
  constexpr std::size_t kPixels = 40'000;
  constexpr std::size_t kFewest = 400;
  const bool pairs = gray.pattern.inverted != InvertedFrames::None && gray.pattern.bits > 1;
  const int width = width_of(gray.frames.front());
  const std::size_t all =
      static_cast<std::size_t>(width) * static_cast<std::size_t>(height_of(gray.frames.front()));
  const std::size_t every = std::max<std::size_t>(1, all / kPixels);
  std::vector<GrayNoiseSample> samples;
  for (std::size_t i = 0; i < all; i += every) {
    const int x = static_cast<int>(i % static_cast<std::size_t>(width));
    const int y = static_cast<int>(i / static_cast<std::size_t>(width));
    pairs ? add_pair_samples(gray, x, y, samples) : add_row_samples(gray, x, y, samples);
  }
  // Dark and saturated pixels vary less than their noise.
  std::erase_if(samples, [&](const GrayNoiseSample& sample) {
    return sample.mean_counts < 0.02F * static_cast<float>(gray.white_level) ||
           sample.mean_counts >
               0.48F * static_cast<float>(gray.white_level) * (pairs ? 1.0F : 2.0F);
  });
  if (samples.size() < kFewest) return {};
  std::sort(samples.begin(), samples.end(), [](const auto& a, const auto& b) {
    return a.mean_counts < b.mean_counts;
  });
  const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
  const std::vector<GrayNoiseSample> dark(samples.begin(), middle);
  const std::vector<GrayNoiseSample> bright(middle, samples.end());
  const NoiseModel quantization;
  const double rise = variance_of_grays(bright) - variance_of_grays(dark);
  const double apart = mean_brightness(bright) - mean_brightness(dark);
  NoiseModel model;
  model.slope_counts = apart > 0.0 ? std::max(rise / apart, 0.0) : 0.0;
  model.floor_counts2 =
      std::max(variance_of_grays(dark) - model.slope_counts * mean_brightness(dark),
               quantization.floor_counts2);
  return model;
}

}  // namespace frangia
