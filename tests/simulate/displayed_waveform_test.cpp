// What the simulated projector shows and the lens blurs, against formulas.
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <set>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/simulate/internal/render_view.h"

#include "support/small_scan.h"

namespace frangia {
namespace {

constexpr double kPeriod_px = 20.0;

/// Frames of a plate without noise, of vertical fringes with evenly spaced shifts.
FrameStack frames_of(const SimulateOptions& given, int shifts) {
  SimulateOptions options = given;
  options.noise = false;
  options.bits = 16;
  const Rig rig = testing::small_rig("digital", 8);
  const SimulatedView view{0, 0.1};
  return render_view(make_simulated_scene(make_part("plate"), rig, {&view, 1}, options),
                     default_patterns(rig, {.periods_px = {kPeriod_px}, .shifts = shifts}),
                     view)
      .front();
}

double counts_of(const FrameStack& stack, std::size_t frame, int x, int y) {
  return static_cast<double>(std::get<Image<std::uint16_t>>(stack.frames[frame])(x, y));
}

/// The brightest pixel over all frames.
Eigen::Vector2i brightest_of(const FrameStack& stack) {
  Eigen::Vector2i best = Eigen::Vector2i::Zero();
  double most = -1.0;
  for (int y = 0; y < height_of(stack.frames.front()); ++y) {
    for (int x = 0; x < width_of(stack.frames.front()); ++x) {
      double sum = 0.0;
      for (std::size_t k = 0; k < stack.frames.size(); ++k)
        sum += counts_of(stack, k, x, y);
      if (sum <= most) continue;
      most = sum;
      best = {x, y};
    }
  }
  return best;
}

/// Harmonics 1 and 3 of the light of the brightest pixel over its frames.
std::array<std::complex<double>, 2> harmonics_of(const FrameStack& stack) {
  const Eigen::Vector2i at = brightest_of(stack);
  const int x = at.x();
  const int y = at.y();
  std::array<std::complex<double>, 2> out{};
  const auto count = static_cast<double>(stack.frames.size());
  for (std::size_t k = 0; k < stack.frames.size(); ++k) {
    const double shift = stack.pattern.shifts_rad[k];
    out[0] += 2.0 / count * counts_of(stack, k, x, y) * std::polar(1.0, -shift);
    out[1] += 2.0 / count * counts_of(stack, k, x, y) * std::polar(1.0, -3.0 * shift);
  }
  return out;
}

TEST(DisplayedWaveform, OfBinaryFringesHasTwoLevels) {
  const FrameStack stack = frames_of({.waveform = DisplayedWaveform::Binary}, 4);
  const Eigen::Vector2i at = brightest_of(stack);
  std::set<int> levels;
  for (std::size_t k = 0; k < 4; ++k)
    levels.insert(static_cast<int>(counts_of(stack, k, at.x(), at.y())));
  EXPECT_EQ(levels.size(), 2U);
}

TEST(DisplayedWaveform, OfBlurredBinaryFringesHasTheHarmonicsOfASquareWaveAfterAGaussian) {
  for (const double blur_px : {1.0, 2.5}) {
    const FrameStack stack =
        frames_of({.waveform = DisplayedWaveform::Binary, .projector_blur_px = blur_px}, 36);
    const double blur_rad = kTwoPi * blur_px / kPeriod_px;
    const auto found = harmonics_of(stack);
    EXPECT_NEAR(
        std::abs(found[1]) / std::abs(found[0]), std::exp(-4.0 * blur_rad * blur_rad) / 3.0, 0.003)
        << blur_px;
  }
}

TEST(DisplayedWaveform, OfDitheredFringesIsNearlyASine) {
  const FrameStack sine = frames_of({}, 12);
  const FrameStack stack =
      frames_of({.waveform = DisplayedWaveform::Dithered, .projector_blur_px = 2.0}, 12);
  const auto found = harmonics_of(stack);
  const double blur_rad = kTwoPi * 2.0 / kPeriod_px;
  EXPECT_NEAR(std::abs(found[0]) / std::abs(harmonics_of(sine)[0]),
              std::exp(-0.5 * blur_rad * blur_rad),
              0.05);
  EXPECT_LT(std::abs(found[1]), 0.03 * std::abs(found[0]));
}

TEST(DisplayedWaveform, OfAnEdgeOfPaintIsBlurredByTheLens) {
  constexpr double kBlur_px = 2.0;
  const auto steepest = [](const FrameStack& stack) {
    double step = 0.0;
    double brightest = 0.0;
    const int height = height_of(stack.frames.front());
    for (int y = height / 3; y < 2 * height / 3; ++y) {
      for (int x = 1; x < width_of(stack.frames.front()); ++x) {
        double here = 0.0;
        double before = 0.0;
        for (std::size_t k = 0; k < stack.frames.size(); ++k) {
          here += counts_of(stack, k, x, y);
          before += counts_of(stack, k, x - 1, y);
        }
        step = std::max(step, std::abs(here - before));
        brightest = std::max(brightest, here);
      }
    }
    return step / brightest;
  };
  const double sharp = steepest(frames_of({.checker_mm = 40.0}, 4));
  const double blurred = steepest(
      frames_of({.samples_per_px = 256, .camera_blur_px = kBlur_px, .checker_mm = 40.0}, 4));
  EXPECT_GT(sharp, 0.7);
  // The steepest step of a blurred edge, from nothing behind the part to white.
  const double expected = 1.0 / (kBlur_px * std::sqrt(kTwoPi));
  EXPECT_NEAR(blurred, expected, 0.2 * expected);
}

}  // namespace
}  // namespace frangia
