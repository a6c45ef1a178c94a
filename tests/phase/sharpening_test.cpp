// Cameras that sharpen their images, made by the published formula of an unsharp mask.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <utility>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/phase/blur/find_sharpening.h"
#include "frangia/phase/blur/undo_sharpening.h"

namespace frangia {
namespace {

constexpr int kWide = 260;
constexpr int kHigh = 180;

/// The image after a convolution with a normal distribution, sampled at whole pixels.
std::vector<double> smoothed(const std::vector<double>& image, double sigma_px) {
  const auto reach = static_cast<int>(4.0 * sigma_px + 0.5);
  const auto pass = [&](const std::vector<double>& from, int right, int down) {
    std::vector<double> to(from.size(), 0.0);
    for (int y = 0; y < kHigh; ++y) {
      for (int x = 0; x < kWide; ++x) {
        double sum = 0.0;
        for (int k = -reach; k <= reach; ++k) {
          const double weight = std::exp(-0.5 * k * k / (sigma_px * sigma_px));
          const int u = std::clamp(x + k * right, 0, kWide - 1);
          const int v = std::clamp(y + k * down, 0, kHigh - 1);
          to[static_cast<std::size_t>(y * kWide + x)] +=
              weight * from[static_cast<std::size_t>(v * kWide + u)];
          sum += weight;
        }
        to[static_cast<std::size_t>(y * kWide + x)] /= sum;
      }
    }
    return to;
  };
  return pass(pass(image, 1, 0), 0, 1);
}

std::vector<double> sharpened(const std::vector<double>& image, double amount, double radius_px) {
  std::vector<double> out = smoothed(image, radius_px);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = image[i] + amount * (image[i] - out[i]);
  return out;
}

using Camera = std::function<std::vector<double>(const std::vector<double>&)>;

struct Shown {
  int steps = 4;
  double period_px = 12.0;  ///< in the image
  double second = 0.0;      ///< harmonic, over the first
  double noise_counts = 1.2;
  double dark_paint = 0.4;
};

/// Fringes on squares of 15 px.
FrameStack captured(const Shown& shown, const Camera& camera, unsigned seed) {
  FrameStack stack;
  stack.pattern = {.name = "f", .period_px = 20.0, .shifts_rad = {}};
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, shown.noise_counts);
  for (int k = 0; k < shown.steps; ++k) {
    stack.pattern.shifts_rad.push_back(kTwoPi * k / shown.steps);
    std::vector<double> light;
    for (int y = 0; y < kHigh; ++y) {
      for (int x = 0; x < kWide; ++x) {
        const double phase =
            kTwoPi * (x + 0.1 * y) / shown.period_px + stack.pattern.shifts_rad.back();
        const double paint = (x / 15 + y / 15) % 2 == 0 ? 1.0 : shown.dark_paint;
        light.push_back(
            20.0 +
            paint * (90.0 + 60.0 * std::cos(phase) + 60.0 * shown.second * std::cos(2 * phase)) +
            noise(random));
      }
    }
    Image<std::uint8_t> frame(kWide, kHigh);
    const std::vector<double> seen = camera(light);
    for (std::size_t i = 0; i < seen.size(); ++i)
      frame.pixels()[i] = static_cast<std::uint8_t>(std::clamp(std::round(seen[i]), 0.0, 255.0));
    stack.frames.emplace_back(std::move(frame));
  }
  return stack;
}

std::vector<FrameStack> two_patterns(const Shown& shown, const Camera& camera) {
  Shown coarse = shown;
  coarse.period_px = 8.0 * shown.period_px;
  return {captured(coarse, camera, 1), captured(shown, camera, 2)};
}

std::vector<double> plain(const std::vector<double>& image) {
  return image;
}

Camera mask(double amount, double radius_px) {
  return [=](const std::vector<double>& image) { return sharpened(image, amount, radius_px); };
}

TEST(FindSharpening, TellsAmountAndRadiusByTheNoise) {
  for (const int steps : {3, 4, 6}) {
    for (const auto& [amount, radius_px] :
         {std::pair{0.4, 1.0}, std::pair{1.0, 1.0}, std::pair{1.5, 0.7}}) {
      const auto found = find_sharpening(two_patterns({.steps = steps}, mask(amount, radius_px)));
      ASSERT_TRUE(found) << steps << " steps, " << amount;
      EXPECT_NEAR(found->amount * found->radius_px * found->radius_px,
                  amount * radius_px * radius_px,
                  (steps == 3 ? 0.5 : 0.3) * amount * radius_px * radius_px)
          << steps << " steps, " << amount << " at " << radius_px;
    }
  }
}

TEST(FindSharpening, FindsNoneInSoundFrames) {
  const auto lens = [](const std::vector<double>& image) { return smoothed(image, 0.6); };
  const auto demosaiced = [&](const std::vector<double>& image) {
    std::vector<double> out = image;
    for (std::size_t i = 1; i + 1 < out.size(); ++i)
      out[i] = 0.25 * image[i - 1] + 0.5 * image[i] + 0.25 * image[i + 1];
    return out;
  };
  const auto few_levels = [](const std::vector<double>& image) {
    std::vector<double> out = image;
    for (double& counts : out)
      counts = 8.0 * std::round(counts / 8.0);
    return out;
  };
  for (const int steps : {3, 4, 6}) {
    EXPECT_FALSE(find_sharpening(two_patterns({.steps = steps}, plain))) << steps;
    EXPECT_FALSE(find_sharpening(two_patterns({.steps = steps, .second = 0.1}, plain))) << steps;
    EXPECT_FALSE(
        find_sharpening(two_patterns({.steps = steps, .period_px = 5.0, .second = 0.1}, plain)));
    EXPECT_FALSE(find_sharpening(two_patterns({.steps = steps, .noise_counts = 0.2}, plain)));
    EXPECT_FALSE(find_sharpening(two_patterns({.steps = steps}, lens)));
    EXPECT_FALSE(find_sharpening(two_patterns({.steps = steps}, demosaiced)));
    EXPECT_FALSE(find_sharpening(two_patterns({.steps = steps}, few_levels), 64.0 / 12.0));
  }
}

/// Root mean square of what the frames differ from those of another stack, counts.
double rms_between(const FrameStack& a, const FrameStack& b) {
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t k = 0; k < a.frames.size(); ++k) {
    for (int y = 0; y < kHigh; ++y) {
      for (int x = 0; x < kWide; ++x) {
        sum += std::pow(counts_at(a.frames[k], x, y) - counts_at(b.frames[k], x, y), 2);
        ++count;
      }
    }
  }
  return std::sqrt(sum / count);
}

TEST(WithoutSharpening, GivesTheFramesBeforeTheMaskUpToTheirRounding) {
  const Shown mild{.noise_counts = 0.5, .dark_paint = 0.8};
  const FrameStack before = captured(mild, plain, 3);
  for (const auto& [amount, radius_px] :
       {std::pair{0.4, 1.0}, std::pair{1.0, 1.5}, std::pair{6.0, 0.4}}) {
    const FrameStack after = captured(mild, mask(amount, radius_px), 3);
    EXPECT_GT(rms_between(before, after), 1.5);
    EXPECT_LT(rms_between(before, without_sharpening(after, {amount, radius_px})), 0.6);
  }
}

TEST(WithoutSharpening, LeavesPixelsThatWereCutOff) {
  FrameStack stack = captured({}, plain, 4);
  auto& frame = std::get<Image<std::uint8_t>>(stack.frames.front());
  frame(50, 60) = 0;
  frame(90, 70) = 255;
  const FrameStack out = without_sharpening(stack, {1.0, 1.0});
  EXPECT_EQ(counts_at(out.frames.front(), 50, 60), 0);
  EXPECT_EQ(counts_at(out.frames.front(), 90, 70), 255);
}

}  // namespace
}  // namespace frangia
