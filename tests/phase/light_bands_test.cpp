// Frames of a rolling shutter in light that flickers, made by the published formulas.
#include "frangia/phase/waveform/light_bands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <random>
#include <utility>
#include <variant>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"

namespace frangia::light_bands {
namespace {

constexpr int kWidth = 260;
constexpr int kHeight = 200;

/// Gain of a frame at a row.
using GainAt = std::function<double(int frame, int row)>;

struct Scene {
  int steps = 6;
  double period_px = 12.0;  ///< of the camera
  double turn_rad = 0.2;    ///< of the fringes against the columns
  double motion_rad = 0.0;  ///< of the phase from frame to frame
  double harmonic = 0.0;    ///< the second one, over the fringes
  double bump_rad = 2.0;    ///< of the part
  double shake_px = 0.0;    ///< displacement of the frames along the columns, largest
  bool is_round = false;    ///< dark at its upper and lower border
};

double true_phase(const Scene& scene, double x, double y) {
  const double along = x * std::cos(scene.turn_rad) + y * std::sin(scene.turn_rad);
  return kTwoPi * along / scene.period_px +
         scene.bump_rad * std::sin(0.02 * x) * std::cos(0.015 * y);
}

FrameStack frames_of(const Scene& scene, const GainAt& gain) {
  FrameStack stack;
  stack.pattern = {.name = "f", .period_px = 20.0, .shifts_rad = {}};
  std::mt19937 generator(9);
  std::normal_distribution<double> noise(0.0, 1.0);
  for (int k = 0; k < scene.steps; ++k) {
    stack.pattern.shifts_rad.push_back(kTwoPi * k / scene.steps);
    Image<std::uint8_t> frame(kWidth, kHeight);
    const double shaken_px = scene.shake_px * std::sin(2.1 * k);
    for (int y = 0; y < kHeight; ++y) {
      const double row = y + shaken_px;
      const double border = scene.is_round ? std::exp(-std::pow((row - 100.0) / 45.0, 2)) : 1.0;
      for (int x = 0; x < kWidth; ++x) {
        const double phase =
            true_phase(scene, x, row) + stack.pattern.shifts_rad.back() + k * scene.motion_rad;
        const double albedo = border * (60.0 + 35.0 * std::sin(0.05 * x) * std::cos(0.07 * row));
        const double light =
            albedo * (1.0 + 0.8 * std::cos(phase) + scene.harmonic * std::cos(2.0 * phase));
        frame(x, y) = static_cast<std::uint8_t>(std::lround(
            std::clamp(12.0 + light * (1.0 + gain(k, y)) + noise(generator), 0.0, 254.0)));
      }
    }
    stack.frames.emplace_back(std::move(frame));
  }
  return stack;
}

double none(int /*frame*/, int /*row*/) {
  return 0.0;
}

/// Four bands of the height of the image, at another place in each frame.
double bands(int frame, int row) {
  constexpr std::array kPlaces = {0.0, 0.1, 0.3, 0.35, 0.55, 0.6, 0.7, 0.9};
  const double place = 4.0 * row / kHeight + kPlaces.at(static_cast<std::size_t>(frame));
  return 0.08 * std::sin(kTwoPi * place);
}

/// RMS error of the phase by least squares.
double phase_error(const Scene& scene, const FrameStack& stack) {
  double square = 0.0;
  double count = 0.0;
  for (int y = 2; y < kHeight - 2; y += 3) {
    for (int x = 0; x < kWidth; x += 2) {
      double cosine = 0.0;
      double sine = 0.0;
      for (std::size_t k = 0; k < stack.frames.size(); ++k) {
        cosine += counts_at(stack.frames[k], x, y) * std::cos(stack.pattern.shifts_rad[k]);
        sine -= counts_at(stack.frames[k], x, y) * std::sin(stack.pattern.shifts_rad[k]);
      }
      square += std::pow(wrap_rad(std::atan2(sine, cosine) - true_phase(scene, x, y)), 2);
      count += 1.0;
    }
  }
  return std::sqrt(square / count);
}

TEST(LightBands, AreFoundAndTakenOut) {
  for (const int steps : {4, 5, 6, 8}) {
    const Scene scene{.steps = steps};
    const FrameStack stack = frames_of(scene, bands);
    const std::optional<LightBands> found = find_light_bands(stack);
    ASSERT_TRUE(found) << steps;
    EXPECT_NEAR(found->rms, 0.08 / std::sqrt(2.0), 0.015) << steps;
    const double sound = phase_error(scene, frames_of(scene, none));
    const double before = phase_error(scene, stack);
    const double after = phase_error(scene, without_bands(stack, *found));
    EXPECT_GT(before, 1.5 * sound) << steps;
    // The gains do not act on the light of the room, 12 counts, as the fit takes it.
    EXPECT_LT(after, 1.7 * sound) << steps << ": " << before << " to " << after;
    EXPECT_LT(after, 0.6 * before) << steps;
  }
}

TEST(LightBands, AreNotFoundInOtherFrames) {
  const auto expect_none = [](const Scene& scene, const GainAt& gain, const char* what) {
    for (const int steps : {4, 6, 8}) {
      Scene one = scene;
      one.steps = steps;
      EXPECT_FALSE(find_light_bands(frames_of(one, gain))) << what << ", " << steps << " steps";
    }
  };
  expect_none({}, none, "sound");
  expect_none({.harmonic = 0.15}, none, "harmonics");
  expect_none({.motion_rad = 0.05}, none, "motion");
  expect_none(
      {}, [](int frame, int) { return 0.05 * std::sin(2.0 * frame); }, "flicker");
  expect_none({.turn_rad = 0.5 * kPi, .harmonic = 0.1}, none, "fringes along the rows");
  expect_none({.period_px = 900.0, .bump_rad = 0.3}, bands, "less than a fringe");
  expect_none(
      {},
      [](int frame, int row) { return frame == 2 && row > 120 ? -0.9 : 0.0; },
      "a frame that is covered");
  expect_none({.turn_rad = 0.02, .bump_rad = 0.3, .shake_px = 1.5, .is_round = true},
              none,
              "a camera that shook");
  expect_none({.steps = 3}, none, "three frames");
  const Scene three{.steps = 3};
  EXPECT_FALSE(find_light_bands(frames_of(three, bands)));
}

TEST(LightBands, LeaveSaturatedPixelsSaturated) {
  FrameStack stack = frames_of({}, bands);
  std::get<Image<std::uint8_t>>(stack.frames[1])(30, 40) = 255;
  const std::optional<LightBands> found = find_light_bands(stack);
  ASSERT_TRUE(found);
  const FrameStack even = without_bands(stack, *found);
  EXPECT_EQ(counts_at(even.frames[1], 30, 40), 255);
  for (const Frame& frame : even.frames)
    for (int x = 0; x < kWidth; ++x)
      EXPECT_LT(counts_at(frame, x, 41), 255);
}

}  // namespace
}  // namespace frangia::light_bands
