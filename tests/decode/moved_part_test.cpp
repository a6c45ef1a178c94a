// A part that moves by parts of a pixel while its frames are taken, and steps that are uneven: by
// closed formulas.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/decode/explain/explain_frames.h"

namespace frangia {
namespace {

constexpr int kPart_px = 200;  ///< width and height of the image

struct Displacement {
  double x_px = 0.0;
  double y_px = 0.0;
  double phase_rad = 0.0;  ///< by a movement in depth
};

/// A printed dome before a wall that stands still, displaced in frame k by `displacement(k)`, with
/// errors of the shifts.
FrameExplanation explained(int steps,
                           unsigned seed,
                           const std::function<Displacement(int)>& displacement,
                           const std::function<double(int)>& shift_error_rad) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> noise;
  FrameStack stack;
  stack.pattern = {.name = "f", .period_px = 20.0, .shifts_rad = {}};
  for (int k = 0; k < steps; ++k) {
    const double shift = kTwoPi * k / steps;
    stack.pattern.shifts_rad.push_back(shift);
    const Displacement moved = displacement(k);
    Image<std::uint8_t> image(kPart_px, kPart_px);
    for (int y = 0; y < kPart_px; ++y) {
      for (int x = 0; x < kPart_px; ++x) {
        const double u = x - moved.x_px - 100.0;
        const double v = y - moved.y_px - 100.0;
        const bool on_part = u * u + v * v < 75.0 * 75.0;
        double albedo = 0.6;
        double phase = kTwoPi * x / 17.0;
        if (on_part) {
          albedo = 0.65 + 0.2 * std::sin(0.5 * u + 0.2 * v) + 0.1 * std::sin(0.31 * v - 0.8 * u);
          phase += 3e-3 * (u * u + v * v) + moved.phase_rad;
        }
        const double light =
            8.0 + 200.0 * albedo * (0.5 + 0.5 * std::cos(phase + shift + shift_error_rad(k)));
        const double sigma = 0.8 * std::sqrt(0.25 + 0.75 * light / 255.0);
        image(x, y) = static_cast<std::uint8_t>(
            std::lround(std::clamp(light + sigma * noise(generator), 0.0, 255.0)));
      }
    }
    stack.frames.emplace_back(std::move(image));
  }
  return explain_frames(stack, {0.16 + 1.0 / 12.0, 0.48 / 255.0});
}

double no_error(int /*frame*/) {
  return 0.0;
}

TEST(MovedPart, IsTakenForNoUnevenSteps) {
  for (const int steps : {6, 8}) {
    for (const double px : {0.3, 0.5}) {
      const std::vector<Displacement> ways{{px, 0.0, 0.0}, {0.0, px, 0.0}, {0.0, 0.0, 0.5 * px}};
      for (std::size_t way = 0; way < ways.size(); ++way) {
        const FrameExplanation found = explained(
            steps,
            7 + static_cast<unsigned>(way),
            [&](int k) { return k >= steps / 2 ? ways[way] : Displacement{}; },
            no_error);
        EXPECT_TRUE(found.has_fault()) << steps << " steps, " << px << " px, way " << way;
        EXPECT_EQ(name_of(found.best.cause), name_of(FrameCause::Moved))
            << steps << " steps, " << px << " px, way " << way << ": "
            << describe(found.explanation);
      }
    }
  }
}

TEST(MovedPart, IsNamedAlsoWhereItMovesAllTheTime) {
  const FrameExplanation found = explained(
      6,
      3,
      [](int k) {
        return Displacement{0.08 * k, 0.04 * k, 0.0};
      },
      no_error);
  EXPECT_TRUE(found.has_fault());
  EXPECT_EQ(name_of(found.best.cause), name_of(FrameCause::Moved)) << describe(found.explanation);
}

TEST(UnevenSteps, AreTakenForNoMovedPart) {
  for (const int steps : {6, 8}) {
    for (const unsigned seed : {1U, 2U, 3U}) {
      std::mt19937 generator(seed);
      std::normal_distribution<double> error(0.0, rad_from_deg(3.0));
      std::vector<double> errors_rad;
      for (int k = 0; k < steps; ++k)
        errors_rad.push_back(error(generator));
      const FrameExplanation found = explained(
          steps,
          seed,
          [](int) { return Displacement{}; },
          [&](int k) { return errors_rad[static_cast<std::size_t>(k)]; });
      EXPECT_TRUE(found.has_fault()) << steps << " steps, seed " << seed;
      EXPECT_EQ(name_of(found.best.cause), name_of(FrameCause::Steps))
          << steps << " steps, seed " << seed << ": " << describe(found.explanation);
    }
  }
}

}  // namespace
}  // namespace frangia
