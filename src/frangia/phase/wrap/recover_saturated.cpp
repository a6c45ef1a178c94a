#include "frangia/phase/wrap/recover_saturated.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/phase/algorithm/published_algorithms.h"

namespace frangia {
namespace {

constexpr int kWhite = std::numeric_limits<std::uint16_t>::max();

}  // namespace

std::size_t recover_saturated(FrameStack& stack) {
  const double step = common_step(stack.pattern.shifts_rad);
  require(stack.frames.size() == 4 && std::abs(std::abs(step) - 0.5 * kPi) < 1e-3,
          "saturated counts can be recovered only from four frames 90 degrees apart");
  const int width = width_of(stack.frames.front());
  const int height = height_of(stack.frames.front());
  std::vector<Image<std::uint16_t>> wide;
  for (const Frame& frame : stack.frames) {
    wide.emplace_back(width, height, Uninitialized{});
    std::visit(
        [&](const auto& image) {
          std::transform(image.pixels().begin(),
                         image.pixels().end(),
                         wide.back().pixels().begin(),
                         [](auto counts) { return static_cast<std::uint16_t>(counts); });
        },
        frame);
  }
  std::size_t recovered = 0;
  for (std::size_t i = 0; i < wide.front().pixels().size(); ++i) {
    std::array<int, 4> counts{};
    int saturated = 0;
    std::size_t which = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      counts[k] = wide[k].pixels()[i];
      if (counts[k] < stack.white_level) continue;
      ++saturated;
      which = k;
    }
    if (saturated == 0) continue;
    // The two neighbours of the saturated frame minus the frame half a turn away.
    const int found = counts[(which + 1) % 4] + counts[(which + 3) % 4] - counts[(which + 2) % 4];
    const bool one = saturated == 1 && found < kWhite;
    if (one) ++recovered;
    wide[which].pixels()[i] =
        static_cast<std::uint16_t>(one ? std::max(found, stack.white_level) : kWhite);
  }
  for (std::size_t k = 0; k < 4; ++k)
    stack.frames[k] = std::move(wide[k]);
  stack.white_level = kWhite;
  return recovered;
}

}  // namespace frangia
