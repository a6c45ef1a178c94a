#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <utility>
#include <vector>

#include "frangia/core/angles.h"
#include "frangia/frames/frame_stack.h"

namespace frangia::testing {

/// Fringes of a display as a camera records them, by formula: I = A + B (0.5 + 0.5 cos)^gamma, with
/// texture, defocus that varies over the picture, noise and quantization. No code of the library
/// takes part.
struct DisplayScene {
  int width = 400;
  int height = 300;
  double period_px = 20.0;  ///< in the picture
  double gamma = 1.0;
  double peak_counts = 180.0;  ///< of B
  double dark_counts = 12.0;   ///< of A
  double texture = 0.5;        ///< share by which patches are darker
  double defocus = 0.15;       ///< share of the contrast that is lost at the left and right ends
  double noise_counts = 1.0;
  int white_level = 255;
  std::vector<double> gains;  ///< relative, one per frame: lamp flicker
  std::uint32_t seed = 1;
  /// Replaces the gamma: light from -1 to 1 over the phase.
  std::function<double(double)> waveform;
};

/// True phase of a pixel: fringes of a curved surface.
inline double display_phase(const DisplayScene& scene, int x, int y) {
  const double bow = 14.0 * std::sin(3.0 * x / scene.width) * std::cos(2.0 * y / scene.height);
  return kTwoPi * (x + 0.13 * y + bow) / scene.period_px;
}

/// 8-bit or 16-bit frames of evenly spaced shifts.
inline FrameStack display_frames(const DisplayScene& scene, const std::vector<double>& shifts_rad) {
  std::mt19937 generator(scene.seed);
  std::normal_distribution<double> noise(0.0, scene.noise_counts);
  FrameStack stack{.pattern = {.name = "p20", .period_px = scene.period_px},
                   .frames = {},
                   .white_level = scene.white_level};
  stack.pattern.shifts_rad = shifts_rad;
  for (std::size_t k = 0; k < shifts_rad.size(); ++k) {
    Image<std::uint16_t> image(scene.width, scene.height);
    for (int y = 0; y < scene.height; ++y) {
      for (int x = 0; x < scene.width; ++x) {
        const double u = 2.0 * x / scene.width - 1.0;
        const double patch = 0.5 + 0.5 * std::sin(0.05 * x + 1.0) * std::sin(0.07 * y);
        const double albedo = 1.0 - scene.texture * patch;
        const double sharp = 1.0 - scene.defocus * u * u;
        const double phase = display_phase(scene, x, y) + shifts_rad[k];
        const double shown = scene.waveform ? 0.5 + 0.5 * scene.waveform(phase)
                                            : std::pow(0.5 + 0.5 * std::cos(phase), scene.gamma);
        const double gain = scene.gains.empty() ? 1.0 : 1.0 + scene.gains[k];
        const double light = 0.4 + sharp * (shown - 0.4);
        const double counts = scene.dark_counts + scene.peak_counts * albedo * light * gain;
        image(x, y) = static_cast<std::uint16_t>(std::clamp<long>(
            std::lround(counts + noise(generator)), 0L, static_cast<long>(scene.white_level)));
      }
    }
    stack.frames.emplace_back(std::move(image));
  }
  return stack;
}

/// Amplitude of harmonic n of (0.5 + 0.5 cos)^gamma relative to the fundamental; the fractional
/// binomial series gives the ratio of successive ones as (gamma - n) / (gamma + n + 1).
inline double gamma_harmonic(double gamma, int order) {
  double amplitude = 1.0;
  for (int n = 1; n < order; ++n)
    amplitude *= (gamma - n) / (gamma + n + 1.0);
  return amplitude;
}

}  // namespace frangia::testing
