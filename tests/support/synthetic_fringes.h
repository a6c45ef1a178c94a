#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "frangia/core/angles.h"
#include "frangia/frames/frame_stack.h"

namespace frangia::testing {

/// What fringes of a known phase look like to a camera.
struct Scene {
  int width = 640;
  int height = 4;
  double mean_counts = 30000.0;
  double modulation_counts = 20000.0;
  double noise_counts = 0.0;
  double step_error = 0.0;  ///< the shifts really made are this share too long
  int white_level = 65535;
  std::uint32_t seed = 1;
};

using PhaseOf = std::function<double(int x, int y)>;

/// 16-bit frames of `phase`, one for each shift of the pattern.
inline FrameStack render_frames(const Scene& scene, const Pattern& pattern, const PhaseOf& phase) {
  std::mt19937 generator(scene.seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  FrameStack stack{.pattern = pattern, .frames = {}, .white_level = scene.white_level};
  for (const double shift : pattern.shifts_rad) {
    Image<std::uint16_t> image(scene.width, scene.height);
    for (int y = 0; y < scene.height; ++y) {
      for (int x = 0; x < scene.width; ++x) {
        const double light = std::cos(phase(x, y) + shift * (1.0 + scene.step_error));
        const double counts = scene.mean_counts + scene.modulation_counts * light +
                              scene.noise_counts * noise(generator);
        image(x, y) = static_cast<std::uint16_t>(
            std::clamp<long>(std::lround(counts), 0L, scene.white_level));
      }
    }
    stack.frames.emplace_back(std::move(image));
  }
  return stack;
}

/// The phase of fringes that run aslant over the picture.
inline double tilted_plane(int x, int y) {
  return 0.09 * x + 0.11 * y;
}

inline std::vector<double> equal_shifts(int count, double step_rad) {
  std::vector<double> shifts;
  shifts.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k)
    shifts.push_back(step_rad * k);
  return shifts;
}

inline Pattern quarter_steps(double fringes_per_degree = 1.0) {
  return {.name = "fringe",
          .fringes_per_degree = fringes_per_degree,
          .shifts_rad = equal_shifts(4, 0.5 * kPi)};
}

}  // namespace frangia::testing
