#pragma once

#include <optional>
#include <string>

#include "frangia/frames/image_file.h"

namespace frangia {

/// How colour frames become grey.
enum class GreyFrom {
  Nothing,    ///< no choice: frames must be grey
  Red,        ///< the red channel
  Green,      ///< the green channel
  Blue,       ///< the blue channel
  Luminance,  ///< 0.299 red + 0.587 green + 0.114 blue (ITU-R BT.601)
  Demosaic    ///< the pixels of a mosaic of colour filters as they are; `color_image` interpolates
};

/// A choice of colour and, for a mosaic, its filters.
struct ColorChoice {
  GreyFrom from = GreyFrom::Nothing;  ///< how frames become grey
  std::string mosaic{};               ///< filters of the pixels (0,0), (1,0), (0,1), (1,1): "RGGB"
};

/// Reads "red", "green", "blue", "luminance" or "demosaic:RGGB" (or BGGR, GRBG, GBRG).
///
/// @errors   Error(Input) that names the text and the choices
[[nodiscard]] ColorChoice parse_color_choice(const std::string& text);

/// Returns whether an image has colour: channels that differ anywhere.
[[nodiscard]] bool has_color(const RasterImage& image);

/// Converts an image to grey. An image with three equal channels needs no choice.
///
/// A mosaic stays as it is. A computed value has fractions: 8-bit samples become 16-bit ones, 257
/// times as large, so that 255 becomes 65535.
/// @shape    one sample per pixel
/// @errors   Error(Input) when the image has colour and `choice` is Nothing or a mosaic
/// @source   ITU-R BT.601 for the weights
[[nodiscard]] Samples grey_image(RasterImage image, const ColorChoice& choice);

/// Returns the red, green and blue of a coloured image, or of a mosaic as `choice` says: bilinear
/// interpolation, whose values are scaled as computed ones of `grey_image`.
///
/// @shape    three samples per pixel
/// @missing  empty for a grey image and for floating-point samples
/// @errors   Error(Input) when a mosaic has fewer than 2 x 2 pixels
[[nodiscard]] std::optional<RasterImage> color_image(const RasterImage& image,
                                                     const ColorChoice& choice);

/// Whether an orientation of EXIF, 1 to 8, exchanges width and height.
[[nodiscard]] constexpr bool exchanges_sides(int orientation) {
  return orientation >= 5;
}

/// Turns an image as its orientation says it is to be shown.
///
/// @shape    width and height are exchanged for 5 to 8
/// @source   TIFF 6.0, section 8: 2 mirrored, 3 by 180 degrees, 4 upside down and mirrored, 6 by 90
///           degrees clockwise, 8 counterclockwise, 5 and 7 these mirrored
[[nodiscard]] RasterImage turn_image(const RasterImage& image, int orientation);

}  // namespace frangia
