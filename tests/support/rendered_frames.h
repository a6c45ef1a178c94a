#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"

namespace frangia::testing {

/// A wavy, textured surface in front of a projector, and the camera that records it: closed
/// formulas, not the simulator.
struct RenderedScene {
  int width = 160;
  int height = 120;
  double period_px = 18.0;  ///< mean width of a fringe in the image
  double ambient = 6.0;     ///< counts
  double light = 190.0;     ///< counts of the brightest pixel
  double gamma = 1.0;       ///< of projector and camera
  bool binary = false;      ///< square fringes, blurred by `blur`
  double blur = 0.15;       ///< transition of a square fringe, in parts of a period
  double flicker = 0.0;     ///< standard deviation of the gains of the frames
  double noise = 0.8;       ///< counts, of a bright pixel; half of it of a dark one
  double shadow = 0.25;     ///< share of the image that the projector does not reach
  unsigned seed = 1;
};

/// The frames of one pattern with these shifts; `shows(frame)` gives the frame whose fringes the
/// projector shows at that time.
class RenderedFrames {
 public:
  explicit RenderedFrames(const RenderedScene& scene, std::vector<double> shifts_deg)
      : scene_(scene), generator_(scene.seed) {
    std::normal_distribution<double> normal;
    for (const double shift : shifts_deg)
      shifts_rad_.push_back(shift * kDegrees);
    for (std::size_t k = 0; k < shifts_rad_.size(); ++k) {
      const double gain = 1.0 + scene.flicker * normal(generator_);
      frames.emplace_back();
      for (int y = 0; y < scene.height; ++y)
        for (int x = 0; x < scene.width; ++x)
          frames.back().push_back(scene.ambient +
                                  gain * albedo(x, y) * projected(phase(x, y) + shifts_rad_[k]));
    }
  }
  RenderedFrames(const RenderedScene& scene, int steps)
      : RenderedFrames(scene, equal_steps(steps)) {}

  static std::vector<double> equal_steps(int steps) {
    std::vector<double> out;
    for (int k = 0; k < steps; ++k)
      out.push_back(360.0 * k / steps);
    return out;
  }

  /// The stack as the camera records it: noise, whole counts, clipped at `ceiling` counts.
  [[nodiscard]] FrameStack stack(int white_level = 255, double ceiling = 255.0) {
    FrameStack out;
    out.pattern.name = "f";
    out.pattern.period_px = 40.0;
    out.pattern.shifts_rad = shifts_rad_;
    out.white_level = white_level;
    std::normal_distribution<double> normal;
    for (const auto& light : frames) {
      Image<std::uint8_t> image(scene_.width, scene_.height);
      for (std::size_t i = 0; i < light.size(); ++i) {
        const double sigma = scene_.noise * std::sqrt(0.25 + 0.75 * light[i] / 255.0);
        image.pixels()[i] = static_cast<std::uint8_t>(
            std::lround(std::clamp(light[i] + sigma * normal(generator_), 0.0, ceiling)));
      }
      out.frames.emplace_back(std::move(image));
    }
    return out;
  }
  [[nodiscard]] NoiseModel noise() const {
    const double variance = scene_.noise * scene_.noise;
    return {0.25 * variance + 1.0 / 12.0, 0.75 * variance / 255.0};
  }

  /// Phase of the fringes at a pixel, rad.
  [[nodiscard]] double phase(int x, int y) const {
    return 2.0 * 3.141592653589793 / scene_.period_px *
           (x + 7.0 * std::sin(0.031 * x + 0.4) * std::cos(0.043 * y) + 0.12 * y);
  }

  std::vector<std::vector<double>> frames;  ///< light of each frame, counts, before the camera

 private:
  static constexpr double kDegrees = 3.141592653589793 / 180.0;

  [[nodiscard]] double albedo(int x, int y) const {
    if (x < scene_.shadow * scene_.width) return 0.0;
    const double shade = 0.7 + 0.3 * std::sin(0.02 * x) * std::sin(0.05 * y + 1.0);
    const bool printed = ((x / 23) + (y / 17)) % 4 == 0;
    return shade * (printed ? 0.55 : 1.0);
  }
  [[nodiscard]] double projected(double angle) const {
    if (scene_.binary) {
      const double wave = std::cos(angle) / std::sin(3.141592653589793 * scene_.blur);
      return scene_.light * (0.5 + 0.5 * std::clamp(wave, -1.0, 1.0));
    }
    return scene_.light * std::pow(0.5 + 0.5 * std::cos(angle), scene_.gamma);
  }

  RenderedScene scene_;
  std::mt19937 generator_;
  std::vector<double> shifts_rad_;
};

}  // namespace frangia::testing
