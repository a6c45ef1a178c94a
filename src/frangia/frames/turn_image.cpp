#include "frangia/frames/turn_image.h"

#include <utility>
#include <variant>

namespace frangia {
namespace {

/// The stored pixel that a pixel of the shown image has; `width_px` and `height_px` of the stored.
std::pair<int, int> stored_pixel(int orientation, int x, int y, int width_px, int height_px) {
  const int right = width_px - 1;
  const int bottom = height_px - 1;
  switch (orientation) {
    case 2:
      return {right - x, y};
    case 3:
      return {right - x, bottom - y};
    case 4:
      return {x, bottom - y};
    case 5:
      return {y, x};
    case 6:
      return {y, bottom - x};
    case 7:
      return {right - y, bottom - x};
    case 8:
      return {right - y, x};
    default:
      return {x, y};
  }
}

}  // namespace

RasterImage turn_image(const RasterImage& image, int orientation) {
  const int width_px = image.width_px();
  const int height_px = image.height_px();
  const bool exchanged = exchanges_sides(orientation);
  const int shown_width_px = exchanged ? height_px : width_px;
  const int shown_height_px = exchanged ? width_px : height_px;
  const int channels = image.channels;
  return {std::visit(
              [&](const auto& stored) -> Samples {
                std::decay_t<decltype(stored)> shown(shown_width_px * channels, shown_height_px);
                for (int y = 0; y < shown_height_px; ++y) {
                  for (int x = 0; x < shown_width_px; ++x) {
                    const auto [sx, sy] = stored_pixel(orientation, x, y, width_px, height_px);
                    for (int c = 0; c < channels; ++c)
                      shown(x * channels + c, y) = stored(sx * channels + c, sy);
                  }
                }
                return shown;
              },
              image.samples),
          channels};
}

}  // namespace frangia
