#include "frangia/decode/explain_no_phase.h"

#include <algorithm>
#include <cstddef>
#include <variant>
#include <vector>

#include <fmt/format.h>

namespace frangia {
namespace {

double percentile_99(const Frame& frame) {
  return std::visit(
      [](const auto& image) {
        std::vector<double> values(image.pixels().begin(), image.pixels().end());
        const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 99 / 100);
        std::nth_element(values.begin(), at, values.end());
        return *at;
      },
      frame);
}

/// The brightest pixels of the fringes and codes, as a share of the white level.
double brightness_of(std::span<const FrameStack> stacks) {
  double bright = 0.0;
  for (const FrameStack& stack : stacks) {
    if (stack.pattern.kind == PatternKind::Ambient) continue;
    for (const Frame& frame : stack.frames)
      bright = std::max(bright, percentile_99(frame) / stack.white_level);
  }
  return bright;
}

}  // namespace

std::string explain_no_phase(std::span<const FrameStack> stacks, const Image<PixelStatus>& status) {
  constexpr double kMost = 0.5;   // share of the pixels
  constexpr double kDark = 0.15;  // of the white level: fringes then have few counts
  constexpr double kAimed = 0.8;  // of the white level, for the brightest pixels
  const auto pixels = status.pixels();
  const auto count = [&](PixelStatus which) {
    return static_cast<double>(std::count(pixels.begin(), pixels.end(), which));
  };
  const auto all = static_cast<double>(pixels.size());
  if (stacks.empty() || count(PixelStatus::Unmodulated) + count(PixelStatus::Saturated) < all)
    return {};
  const double saturated = count(PixelStatus::Saturated) / std::max(1.0, all);
  const std::string none = "no pixel has a phase: ";
  if (saturated > kMost) {
    return none + fmt::format(
                      "{:.0f} % of the pixels are saturated; expose shorter, close the "
                      "aperture, or correct white_level in rig.toml",
                      100.0 * saturated);
  }
  const double bright = brightness_of(stacks);
  if (bright < kDark) {
    return none + fmt::format(
                      "the frames are dark, 99 % of their pixels stay below {:.1f} % of the white "
                      "level; expose about {:.0f} times longer, open the aperture, add light, or "
                      "correct white_level in rig.toml",
                      100.0 * bright,
                      kAimed / std::max(bright, 0.01));
  }
  return none + fmt::format(
                    "no frame shows fringes beyond the noise, although the brightest pixels reach "
                    "{:.0f} % of the white level; check that the projector shows the patterns in "
                    "step with the camera, that they are in focus, and that the part is in view",
                    100.0 * bright);
}

}  // namespace frangia
