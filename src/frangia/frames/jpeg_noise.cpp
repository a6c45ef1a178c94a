#include "frangia/frames/jpeg_noise.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace frangia {
namespace {

/// ITU-T T.81, table K.1: quantization of the brightness, in natural order.
constexpr std::array<int, 64> kBaseSteps = {
    16, 11, 10, 16, 24,  40,  51,  61,  12, 12, 14, 19, 26,  58,  60,  55,
    14, 13, 16, 24, 40,  57,  69,  56,  14, 17, 22, 29, 51,  87,  80,  62,
    18, 22, 37, 56, 68,  109, 103, 77,  24, 35, 55, 64, 81,  104, 113, 92,
    49, 64, 78, 87, 103, 121, 120, 101, 72, 92, 95, 98, 112, 100, 103, 99};

/// The table of a quality, as jpeg_set_quality of libjpeg computes it.
std::array<int, 64> steps_of(int quality) {
  const int scale = quality < 50 ? 5000 / quality : 200 - 2 * quality;
  std::array<int, 64> steps{};
  for (std::size_t i = 0; i < steps.size(); ++i)
    steps[i] = std::clamp((kBaseSteps[i] * scale + 50) / 100, 1, 255);
  return steps;
}

}  // namespace

int jpeg_quality(const std::array<int, 64>& steps) {
  int best = 1;
  long least = -1;
  for (int quality = 1; quality <= 100; ++quality) {
    const std::array<int, 64> known = steps_of(quality);
    long difference = 0;
    for (std::size_t i = 0; i < steps.size(); ++i)
      difference += std::abs(known[i] - steps[i]);
    if (least >= 0 && difference >= least) continue;
    best = quality;
    least = difference;
  }
  return best;
}

const std::array<int, 64>& jpeg_base_steps() {
  return kBaseSteps;
}

double jpeg_quality_of_scale(double scale) {
  return std::clamp(scale > 1.0 ? 50.0 / scale : 100.0 - 50.0 * scale, 1.0, 100.0);
}

double jpeg_noise_counts2(int quality) {
  return jpeg_noise_of_scale(quality < 50 ? 50.0 / quality : (200.0 - 2.0 * quality) / 100.0);
}

double jpeg_noise_of_scale(double scale) {
  // Rounding to whole counts is there at any quality.
  constexpr double kRounding_counts2 = 0.05;
  constexpr double kAtScaleOne_counts2 = 12.0;
  return kRounding_counts2 + kAtScaleOne_counts2 * std::pow(scale, 1.5);
}

}  // namespace frangia
