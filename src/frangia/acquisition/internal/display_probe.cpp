#include "frangia/acquisition/internal/display_probe.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace frangia {
namespace {

double mean_over(const std::vector<std::size_t>& at, const Frame& frame) {
  const auto width = static_cast<std::size_t>(width_of(frame));
  double sum = 0.0;
  for (const std::size_t i : at)
    sum += counts_at(frame, static_cast<int>(i % width), static_cast<int>(i / width));
  return at.empty() ? 0.0 : sum / static_cast<double>(at.size());
}

}  // namespace

LitPixels::LitPixels(const Frame& dark, const Frame& bright, int white_level, double min_contrast) {
  const int width = width_of(bright);
  for (int y = 0; y < height_of(bright); ++y) {
    for (int x = 0; x < width; ++x) {
      const int counts = counts_at(bright, x, y);
      if (counts < white_level && counts - counts_at(dark, x, y) > min_contrast * white_level)
        at_.push_back(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x));
    }
  }
  dark_ = mean_over(at_, dark);
  bright_ = mean_over(at_, bright);
}

double LitPixels::mean_of(const Frame& frame) const {
  return mean_over(at_, frame);
}

double LitPixels::zeros_of(const Frame& frame) const {
  const auto width = static_cast<std::size_t>(width_of(frame));
  const auto zeros = std::count_if(at_.begin(), at_.end(), [&](std::size_t i) {
    return counts_at(frame, static_cast<int>(i % width), static_cast<int>(i / width)) == 0;
  });
  return at_.empty() ? 0.0 : static_cast<double>(zeros) / static_cast<double>(at_.size());
}

double LitPixels::share_of(const Frame& frame) const {
  return (mean_of(frame) - dark_) / (bright_ - dark_);
}

DisplayProbe::DisplayProbe(RigDevices& devices,
                           const Rig& rig,
                           const CaptureOptions& options,
                           const Run& run)
    : devices_(devices),
      rig_(rig),
      run_(run),
      session_(devices, rig, options, run),
      delay_s_(devices.display->delay_s()) {}

CompleteFrame DisplayProbe::take(const Pattern& pattern, int frame) {
  run_.check();
  session_.show(pattern, frame);
  return again(pattern.name);
}

CompleteFrame DisplayProbe::again(const std::string& pattern) {
  for (std::size_t i = 0; i < skipped_; ++i)
    static_cast<void>(session_.capture({0, pattern, taken_++, 0, 0}));
  return session_.capture({0, pattern, taken_++, 0, 0});
}

FrameStack DisplayProbe::stack_of(const Pattern& pattern) {
  FrameStack stack{pattern, {}, rig_.reference().white_level};
  for (int frame = 0; frame < pattern.frame_count(); ++frame)
    stack.frames.push_back(take(pattern, frame).frame);
  return stack;
}

Pattern dark_and_bright() {
  Pattern pattern{.name = "flash", .kind = PatternKind::Ramp};
  pattern.levels = {0.0, 1.0};
  return pattern;
}

namespace {

double flash_at(std::size_t number) {
  return kFlashCode[number % kFlashCode.size()] ? 1.0 : 0.0;
}

FlashLag fit_share(std::span<const double> light, std::size_t frames) {
  const std::size_t length = kFlashCode.size();
  const auto present = [&](std::size_t k) { return flash_at(k + length - frames); };
  const auto change = [&](std::size_t k) {
    return flash_at(k + 2 * length - frames - 1) - present(k);
  };
  double product = 0.0;
  double square = 0.0;
  for (std::size_t k = 0; k < light.size(); ++k) {
    product += (light[k] - present(k)) * change(k);
    square += change(k) * change(k);
  }
  FlashLag lag{.frames = frames};
  // The same lag as one frame more with a share that noise makes a little negative.
  constexpr double kNoise = 0.1;
  if (square > 0.0) lag.share = std::clamp(product / square, -kNoise, 1.0 - kNoise);
  double sum = 0.0;
  for (std::size_t k = 0; k < light.size(); ++k) {
    const double left = light[k] - present(k) - lag.share * change(k);
    sum += left * left;
  }
  lag.residual = std::sqrt(sum / static_cast<double>(light.size()));
  return lag;
}

}  // namespace

FlashLag flash_lag(std::span<const double> light) {
  FlashLag best{.residual = std::numeric_limits<double>::infinity()};
  for (std::size_t frames = 0; frames < kFlashCode.size(); ++frames) {
    const FlashLag lag = fit_share(light, frames);
    if (lag.residual < best.residual) best = lag;
  }
  return best;
}

}  // namespace frangia
