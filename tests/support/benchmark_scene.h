#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "frangia/core/angles.h"
#include "frangia/core/random.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"

namespace frangia::testing {

/// Phase of a waved surface over a few tens of fringes.
inline double benchmark_phase(double u, double v) {
  return kTwoPi * (40.0 * u + 3.0 * std::sin(5.0 * u + 2.0 * v) + 2.0 * std::cos(7.0 * v));
}

/// Share of full light: falling to the corners, with round holes and the shadow of a bar.
inline double benchmark_light(double u, double v) {
  const double hole_u = u * 8.0 - std::floor(u * 8.0) - 0.5;
  const double hole_v = v * 8.0 - std::floor(v * 8.0) - 0.5;
  if (hole_u * hole_u + hole_v * hole_v < 0.03) return 0.0;
  if (std::abs(u + 0.6 * v - 0.8) < 0.02) return 0.0;
  return 1.0 - 0.6 * ((u - 0.5) * (u - 0.5) + (v - 0.5) * (v - 0.5));
}

/// What the camera of the frames has.
inline constexpr NoiseModel kBenchmarkNoise{4.0 + 1.0 / 12.0, 0.2};

/// Four 8-bit frames of `phase(u, v)`, 90 degrees apart, with shot and read noise, holes and
/// shadows.
template <typename PhaseOf>
FrameStack benchmark_frames(int width, int height, const PhaseOf& phase) {
  FrameStack stack{.pattern = {.name = "fringe", .fringes_per_degree = 1.0}, .white_level = 255};
  for (int k = 0; k < 4; ++k)
    stack.pattern.shifts_rad.push_back(0.5 * kPi * k);
  for (int k = 0; k < 4; ++k) {
    Image<std::uint8_t> image(width, height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const double u = (x + 0.5) / width;
        const double v = (y + 0.5) / height;
        const double light = benchmark_light(u, v);
        const double counts =
            4.0 + 100.0 * light * (1.0 + 0.8 * std::cos(phase(u, v) + 0.5 * kPi * k));
        const auto place = (static_cast<std::uint64_t>(y) << 32U) | static_cast<std::uint64_t>(x);
        const double noise = std::sqrt(4.0 + 0.2 * counts) *
                             normal_from(hash(static_cast<std::uint64_t>(k) + 1, place));
        image(x, y) =
            static_cast<std::uint8_t>(std::lround(std::clamp(counts + noise, 0.0, 255.0)));
      }
    }
    stack.frames.emplace_back(std::move(image));
  }
  return stack;
}

inline FrameStack benchmark_frames(int width, int height) {
  return benchmark_frames(width, height, benchmark_phase);
}

}  // namespace frangia::testing
