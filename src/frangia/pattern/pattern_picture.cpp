#include "frangia/pattern/pattern_picture.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/pattern/gray_code.h"

namespace frangia {
namespace {

[[noreturn]] void fail(const Pattern& pattern, const char* why) {
  throw Error(ErrorKind::Input, fmt::format("pattern \"{}\" {}", pattern.name, why));
}

/// Light from 0 to 1 at a position across the fringes, in pixels.
float light_at(const Pattern& pattern, int frame, int position) {
  const auto index = static_cast<std::size_t>(frame);
  if (pattern.kind == PatternKind::White) return 1.0F;
  if (pattern.kind == PatternKind::Ambient) return 0.0F;
  if (pattern.kind == PatternKind::Ramp) return static_cast<float>(pattern.levels[index]);
  if (pattern.kind == PatternKind::Gray)
    return is_stripe_bright(pattern, frame, position) ? 1.0F : 0.0F;
  const double phase = kTwoPi * position / pattern.period_px + pattern.shifts_rad[index];
  return static_cast<float>(0.5 + 0.5 * std::cos(phase));
}

}  // namespace

Image<float> pattern_picture(
    const Pattern& pattern, int frame, int width, int height, PixelLayout layout) {
  if (pattern.kind == PatternKind::Line)
    fail(pattern, "is of kind line, which a digital projector does not show");
  if (pattern.kind == PatternKind::Fringe && !(pattern.period_px > 0.0))
    fail(pattern, "needs a period_px above 0 to be shown by a digital projector");
  if (frame < 0 || frame >= pattern.frame_count()) fail(pattern, "has no frame of this number");
  const bool vertical = pattern.direction == FringeDirection::Vertical;
  // Rows 0 and 1 hold all columns of the chip that a row can have.
  std::vector<float> across;
  const int positions = vertical ? chip_column(layout, width - 1, 1) + 1 : height;
  for (int position = 0; position < positions; ++position)
    across.push_back(light_at(pattern, frame, position));
  Image<float> picture(width, height, Uninitialized{});
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int position = vertical ? chip_column(layout, x, y) : y;
      picture(x, y) = across[static_cast<std::size_t>(position)];
    }
  }
  return picture;
}

}  // namespace frangia
