#pragma once

#include <array>

#include "frangia/core/enum_names.h"
#include "frangia/core/image.h"
#include "frangia/pattern/pattern.h"

namespace frangia {

/// How the pixels of a digital projector lie on its chip.
enum class PixelLayout {
  Square,  ///< in rows and columns
  /// In rows of which every second one, from the second, is shifted right by half a pixel; a row is
  /// half as high as a pixel is wide (DLP LightCrafter 4500: 912 x 1140 pixels). Patterns and the
  /// model of the projector count in heights of rows, in which the chip has 1824 x 1140.
  Diamond
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(PixelLayout /*any*/) {
  return EnumNames<PixelLayout, 2>{
      {{PixelLayout::Square, "square"}, {PixelLayout::Diamond, "diamond"}}};
}

/// Width and height of the image that such a projector is given, for a chip of `width` x `height`
/// in the unit of patterns.
///
/// @units    px
[[nodiscard]] constexpr std::array<int, 2> image_size(PixelLayout layout, int width, int height) {
  return {layout == PixelLayout::Diamond ? width / 2 : width, height};
}

/// Column on the chip of pixel (x, y) of the image, in the unit of patterns.
///
/// @units    px
[[nodiscard]] constexpr int chip_column(PixelLayout layout, int x, int y) {
  return layout == PixelLayout::Diamond ? 2 * x + y % 2 : x;
}

/// Renders one frame of a pattern for a digital projector.
///
/// @shape    width x height pixels of the image that the projector is given
/// @units    linear light from 0 (dark) to 1 (full)
/// @errors   Error(Input) for a pattern of kind line, for fringes without a period, or for a frame
///          number out of range
[[nodiscard]] Image<float> pattern_picture(const Pattern& pattern,
                                           int frame,
                                           int width,
                                           int height,
                                           PixelLayout layout = PixelLayout::Square);

}  // namespace frangia
