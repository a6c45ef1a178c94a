#include "frangia/acquisition/internal/flash_code.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frangia {
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
