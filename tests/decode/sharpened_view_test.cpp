// A view of a camera that sharpens its images, made by the published formulas.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/core/missing.h"
#include "frangia/decode/decode_view.h"
#include "frangia/phase/wrap/wrap_phase.h"

namespace frangia {
namespace {

constexpr int kSharpWide = 320;
constexpr int kSharpHigh = 160;

double column_at(double x, double y) {
  return 40.0 + 1.4 * x + 0.0015 * x * x + 6.0 * std::sin(0.03 * y);
}

/// Adds 1.2 of what a blur of a pixel takes off. Its weights are those of a normal distribution.
void sharpen(std::vector<double>& image) {
  constexpr double kAmount = 1.2;
  const auto at = [](const std::vector<double>& from, int x, int y) {
    return from[static_cast<std::size_t>(std::clamp(y, 0, kSharpHigh - 1) * kSharpWide +
                                         std::clamp(x, 0, kSharpWide - 1))];
  };
  std::vector<double> blurred(image.size(), 0.0);
  double whole = 0.0;
  for (int v = -4; v <= 4; ++v) {
    for (int u = -4; u <= 4; ++u) {
      const double weight = std::exp(-0.5 * (u * u + v * v));
      whole += weight;
      for (int y = 0; y < kSharpHigh; ++y)
        for (int x = 0; x < kSharpWide; ++x)
          blurred[static_cast<std::size_t>(y * kSharpWide + x)] += weight * at(image, x + u, y + v);
    }
  }
  for (std::size_t i = 0; i < image.size(); ++i)
    image[i] += kAmount * (image[i] - blurred[i] / whole);
}

/// Four steps of fringes on painted squares of 16 pixels; a lens blurs them by half a pixel.
FrameStack of_painted_part(double period_px, bool sharpens) {
  FrameStack stack;
  stack.pattern = {
      .name = period_px > 100.0 ? "coarse" : "fine", .period_px = period_px, .shifts_rad = {}};
  std::mt19937 random(static_cast<unsigned>(period_px));
  std::normal_distribution<double> noise(0.0, 1.2);
  constexpr int kAcross = 2;
  for (int k = 0; k < 4; ++k) {
    stack.pattern.shifts_rad.push_back(kTwoPi * k / 4);
    std::vector<double> light;
    for (int y = 0; y < kSharpHigh; ++y) {
      for (int x = 0; x < kSharpWide; ++x) {
        double sum = 0.0;
        double whole = 0.0;
        for (int j = -kAcross; j < 2 * kAcross; ++j) {
          for (int i = -kAcross; i < 2 * kAcross; ++i) {
            const double dx = (i + 0.5) / kAcross - 0.5;
            const double dy = (j + 0.5) / kAcross - 0.5;
            const double weight = std::exp(-2.0 * (dx * dx + dy * dy));
            const auto square = [](double at) { return static_cast<int>(std::floor(at / 16.0)); };
            const double paint =
                (square(x + dx + 0.25) + square(y + dy + 0.25)) % 2 == 0 ? 1.0 : 0.25;
            const double phase =
                kTwoPi * column_at(x + dx, y + dy) / period_px + stack.pattern.shifts_rad.back();
            sum += weight * (30.0 + paint * (80.0 + 70.0 * std::cos(phase)));
            whole += weight;
          }
        }
        light.push_back(sum / whole + noise(random));
      }
    }
    if (sharpens) sharpen(light);
    Image<std::uint8_t> frame(kSharpWide, kSharpHigh);
    for (std::size_t i = 0; i < light.size(); ++i)
      frame.pixels()[i] = static_cast<std::uint8_t>(std::clamp(std::round(light[i]), 0.0, 255.0));
    stack.frames.emplace_back(std::move(frame));
  }
  return stack;
}

struct SharpnessOfView {
  double rad = 0.0;         ///< RMS of the error
  double over_sigma = 0.0;  ///< RMS of the error over its uncertainty
  int told = 0;             ///< warnings of a sharpened image
};

SharpnessOfView decoded(const std::vector<FrameStack>& captured) {
  Rig rig;
  rig.reference().model.width_px = kSharpWide;
  rig.reference().model.height_px = kSharpHigh;
  rig.projector.model = CameraModel{.width_px = 1280, .height_px = 480};
  SharpnessOfView out;
  frangia::Run run;
  run.on_warning = [&](const std::string& sentence) {
    out.told += sentence.find("the camera sharpens its frames") != std::string::npos ? 1 : 0;
  };
  const DecodedView view = decode_view(captured, rig, {}, {}, run);
  const AbsolutePhase& phase = view.directions.front().phase;
  double count = 0.0;
  for (int y = 4; y < kSharpHigh - 4; ++y) {
    for (int x = 4; x < kSharpWide - 4; ++x) {
      if (std::isnan(phase.phase_rad(x, y))) continue;
      const double error = std::remainder(
          static_cast<double>(phase.phase_rad(x, y)) - kTwoPi * column_at(x, y) / 20.0, kTwoPi);
      const double sigma = std::hypot(
          static_cast<double>(phase.sigma_rad(x, y)),
          phase.systematic_rad.empty() ? 0.0 : static_cast<double>(phase.systematic_rad(x, y)));
      out.rad += error * error;
      out.over_sigma += error * error / (sigma * sigma);
      ++count;
    }
  }
  EXPECT_GT(count, 0.7 * kSharpWide * kSharpHigh);
  out.rad = std::sqrt(out.rad / count);
  out.over_sigma = std::sqrt(out.over_sigma / count);
  return out;
}

TEST(SharpenedView, IsMeasuredAsWithoutTheMaskAndSaysSo) {
  const SharpnessOfView sound =
      decoded({of_painted_part(1280.0, false), of_painted_part(20.0, false)});
  EXPECT_EQ(sound.told, 0);
  const SharpnessOfView sharp =
      decoded({of_painted_part(1280.0, true), of_painted_part(20.0, true)});
  EXPECT_EQ(sharp.told, 1);
  EXPECT_LT(sharp.rad, 1.3 * sound.rad);
  EXPECT_LT(sharp.over_sigma, 1.3);
}

TEST(SharpenedView, GivesAnOwnFunctionTheFramesAsCaptured) {
  const std::vector<FrameStack> captured{of_painted_part(20.0, true)};
  Rig rig;
  rig.reference().model.width_px = kSharpWide;
  rig.reference().model.height_px = kSharpHigh;
  rig.projector.model = CameraModel{.width_px = 1280, .height_px = 480};
  DecodeOptions own;
  int seen = 0;
  own.own.wrap =
      [&](const FrameStack& stack, const FittedAlgorithm& fitted, const NoiseModel& noise) {
        seen = counts_at(stack.frames[2], 48, 40);
        return wrap_phase(stack, fitted.algorithm, noise);
      };
  static_cast<void>(decode_view(captured, rig, {}, own, {}));
  EXPECT_EQ(seen, counts_at(captured.front().frames[2], 48, 40));
}

}  // namespace
}  // namespace frangia
