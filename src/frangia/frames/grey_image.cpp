#include "frangia/frames/grey_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/parallel.h"

namespace frangia {
namespace {

constexpr std::array<double, 3> kLuminance = {0.299, 0.587, 0.114};

/// The type of a computed value: 16 bits for whole numbers.
template <typename T>
using Computed = std::conditional_t<std::is_floating_point_v<T>, float, std::uint16_t>;

/// A computed value in the type of the result.
template <typename T>
Computed<T> computed(double value) {
  if constexpr (std::is_floating_point_v<T>) return static_cast<float>(value);
  const double scale = sizeof(T) == 1 ? 257.0 : 1.0;
  return static_cast<Computed<T>>(std::lround(scale * value));
}

template <typename T>
Image<T> one_channel(const Image<T>& image, int channel) {
  Image<T> grey(image.width() / 3, image.height(), Uninitialized{});
  for (std::size_t i = 0; i < grey.pixels().size(); ++i)
    grey.pixels()[i] = image.pixels()[3 * i + static_cast<std::size_t>(channel)];
  return grey;
}

template <typename T>
Image<Computed<T>> luminance_of(const Image<T>& image) {
  Image<Computed<T>> grey(image.width() / 3, image.height(), Uninitialized{});
  for (std::size_t i = 0; i < grey.pixels().size(); ++i) {
    double sum = 0.0;
    for (std::size_t c = 0; c < kLuminance.size(); ++c)
      sum += kLuminance[c] * static_cast<double>(image.pixels()[3 * i + c]);
    grey.pixels()[i] = computed<T>(sum);
  }
  return grey;
}

/// Bilinear interpolation: the mean of the nearest pixels with each filter, which are the pixel
/// itself, two or four neighbours. Calls `use(x, y, red, green, blue)`.
template <typename T, typename Use>
void demosaic(const Image<T>& image, const std::string& mosaic, const Use& use) {
  const auto filter_at = [&](int x, int y) {
    constexpr std::string_view kFilters = "RGB";
    const int place = 2 * (y & 1) + (x & 1);
    return kFilters.find(mosaic[static_cast<std::size_t>(place)]);
  };
  // Mirrored about the outermost pixels, so that the filters continue.
  const auto mirrored = [](int at, int side) {
    return at < 0 ? -at : at >= side ? 2 * side - 2 - at : at;
  };
  parallel_rows(image.height(), [&](int y) {
    for (int x = 0; x < image.width(); ++x) {
      std::array<double, 3> sums{};
      std::array<double, 3> counts{};
      const std::size_t own = filter_at(x, y);
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const int at_x = mirrored(x + dx, image.width());
          const int at_y = mirrored(y + dy, image.height());
          const std::size_t filter = filter_at(at_x, at_y);
          const bool centre = dx == 0 && dy == 0;
          // Green at a diagonal is farther than green beside the pixel.
          if (centre != (filter == own)) continue;
          if (filter == 1 && dx != 0 && dy != 0) continue;
          sums[filter] += static_cast<double>(image(at_x, at_y));
          counts[filter] += 1.0;
        }
      }
      for (std::size_t c = 0; c < sums.size(); ++c)
        sums[c] /= counts[c];
      use(x, y, sums);
    }
  });
}

template <typename T>
Image<Computed<T>> demosaiced_color(const Image<T>& image, const std::string& mosaic) {
  Image<Computed<T>> color(3 * image.width(), image.height(), Uninitialized{});
  demosaic(image, mosaic, [&](int x, int y, const std::array<double, 3>& channels) {
    for (std::size_t c = 0; c < channels.size(); ++c)
      color(3 * x + static_cast<int>(c), y) = computed<T>(channels[c]);
  });
  return color;
}

template <typename T>
bool channels_differ(const Image<T>& image) {
  for (std::size_t i = 0; i + 2 < image.pixels().size(); i += 3) {
    const auto* const pixel = &image.pixels()[i];
    if (pixel[0] != pixel[1] || pixel[0] != pixel[2]) return true;
  }
  return false;
}

}  // namespace

ColorChoice parse_color_choice(const std::string& text) {
  constexpr std::array<std::pair<std::string_view, GreyFrom>, 4> kNames = {
      {{"red", GreyFrom::Red},
       {"green", GreyFrom::Green},
       {"blue", GreyFrom::Blue},
       {"luminance", GreyFrom::Luminance}}};
  for (const auto& [name, from] : kNames)
    if (text == name) return {from};
  for (const std::string_view mosaic : {"RGGB", "BGGR", "GRBG", "GBRG"}) {
    if (text == fmt::format("demosaic:{}", mosaic))
      return {GreyFrom::Demosaic, std::string(mosaic)};
  }
  throw Error(ErrorKind::Input,
              fmt::format("`color` is \"{}\"; it must be red, green, blue, luminance, or demosaic: "
                          "with RGGB, BGGR, GRBG or GBRG",
                          text));
}

bool has_color(const RasterImage& image) {
  return image.channels == 3 &&
         std::visit([](const auto& samples) { return channels_differ(samples); }, image.samples);
}

std::optional<RasterImage> color_image(const RasterImage& image, const ColorChoice& choice) {
  if (std::holds_alternative<Image<float>>(image.samples)) return std::nullopt;
  if (image.channels == 3) return has_color(image) ? std::optional(image) : std::nullopt;
  if (choice.from != GreyFrom::Demosaic) return std::nullopt;
  require(image.width_px() >= 2 && image.height_px() >= 2,
          "a mosaic has at least 2 x 2 pixels; set another `color`");
  return std::visit(
      [&](const auto& samples) {
        return std::optional(RasterImage{demosaiced_color(samples, choice.mosaic), 3});
      },
      image.samples);
}

Samples grey_image(RasterImage image, const ColorChoice& choice) {
  // The phase of a pixel does not depend on the gain of its channel, while interpolated pixels have
  // errors that are common to neighbours, and that their noise does not show.
  if (image.channels == 1) return std::move(image.samples);
  const GreyFrom from = choice.from;
  if (from == GreyFrom::Nothing || from == GreyFrom::Demosaic) {
    require(!has_color(image),
            from == GreyFrom::Nothing
                ? "is a colour image; set `color` to red, green, blue or luminance"
                : "is a colour image, not a mosaic; set `color` to red, green, blue or luminance");
  }
  return std::visit(
      [&](const auto& samples) -> Samples {
        if (from == GreyFrom::Luminance) return luminance_of(samples);
        return one_channel(samples, from == GreyFrom::Green ? 1 : from == GreyFrom::Blue ? 2 : 0);
      },
      image.samples);
}

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
