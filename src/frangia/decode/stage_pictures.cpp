#include "frangia/decode/stage_pictures.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "frangia/core/angles.h"
#include "frangia/frames/map_picture.h"
#include "frangia/phase/spatial/find_residues.h"

namespace frangia {
namespace {

constexpr Rgb kMissingColor{36, 40, 52};
constexpr Rgb kGain{230, 40, 40};
constexpr Rgb kLoss{40, 110, 250};

/// Draws a square around a loop, large enough to be seen when the picture fills a screen.
void draw_residue(const Residue& residue, Image<Rgb>& picture) {
  const int reach = std::max(2, picture.width() / 250);
  const int left = std::max(0, residue.x + 1 - reach);
  const int top = std::max(0, residue.y + 1 - reach);
  for (int y = top; y < std::min(picture.height(), residue.y + 1 + reach); ++y) {
    for (int x = left; x < std::min(picture.width(), residue.x + 1 + reach); ++x)
      picture(x, y) = residue.turns > 0 ? kGain : kLoss;
  }
}

}  // namespace

const std::vector<StatusLegend>& status_legend() {
  static const std::vector<StatusLegend> legend = {
      {PixelStatus::Measured, {230, 230, 225}, "white", "measured"},
      {PixelStatus::Filled, {110, 200, 120}, "green", "filled from neighbours"},
      {PixelStatus::Unmodulated, kMissingColor, "dark", "unmodulated: background or shadow"},
      {PixelStatus::Saturated, {220, 60, 50}, "red", "saturated in a frame"},
      {PixelStatus::Residue, {160, 80, 200}, "purple", "phase residue"},
      {PixelStatus::UncertainOrder, {240, 170, 40}, "orange", "fringe order uncertain"},
      {PixelStatus::Unresolved, {70, 130, 220}, "blue", "fringe order unresolved"},
      {PixelStatus::MixedPixel, {240, 220, 90}, "yellow", "mixed pixel at a depth edge"},
      {PixelStatus::OutOfField, {120, 100, 90}, "brown", "phase outside the projector's field"},
      {PixelStatus::Contradicting, {235, 120, 190}, "pink", "frames contradict each other"}};
  return legend;
}

Image<Rgb> status_picture(const Image<PixelStatus>& status) {
  Image<Rgb> picture(status.width(), status.height());
  for (std::size_t i = 0; i < status.pixels().size(); ++i)
    picture.pixels()[i] = status_legend()[static_cast<std::size_t>(status.pixels()[i])].color;
  return picture;
}

Image<Rgb> residue_picture(const Image<float>& wrapped_rad) {
  constexpr auto kHalfTurn = static_cast<float>(kPi);
  Image<Rgb> picture = map_picture(wrapped_rad, {-kHalfTurn, kHalfTurn}, ColorMap::Gray);
  for (const Residue& residue : find_residues(wrapped_rad))
    draw_residue(residue, picture);
  return picture;
}

Image<Rgb> growth_picture(const Image<std::int32_t>& order) {
  Image<Rgb> picture(order.width(), order.height(), kMissingColor);
  const auto places = order.pixels();
  const std::int32_t last = std::max(1, *std::max_element(places.begin(), places.end()));
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i] < 0) continue;
    const float share = static_cast<float>(places[i]) / static_cast<float>(last);
    picture.pixels()[i] = pixel_of(ColorMap::Viridis, share);
  }
  return picture;
}

Image<Rgb> label_picture(const Image<std::int32_t>& number) {
  Image<Rgb> picture(number.width(), number.height(), kMissingColor);
  for (std::size_t i = 0; i < number.pixels().size(); ++i) {
    const std::int32_t one = number.pixels()[i];
    if (one < 0) continue;
    const double golden = 0.6180339887 * (one + 1);
    picture.pixels()[i] =
        pixel_of(ColorMap::Viridis, static_cast<float>(golden - std::floor(golden)));
  }
  return picture;
}

Image<std::int32_t> fringe_orders(const Image<float>& wrapped_rad,
                                  const Image<float>& absolute_rad) {
  Image<std::int32_t> number(wrapped_rad.width(), wrapped_rad.height(), -1);
  const auto fringe = [&](std::size_t i) {
    const double apart = static_cast<double>(absolute_rad.pixels()[i]) - wrapped_rad.pixels()[i];
    return std::round(apart / kTwoPi);
  };
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < number.pixels().size(); ++i)
    lowest = std::fmin(lowest, fringe(i));
  for (std::size_t i = 0; i < number.pixels().size(); ++i) {
    const double above = fringe(i) - lowest;
    if (!std::isnan(above)) number.pixels()[i] = static_cast<std::int32_t>(above);
  }
  return number;
}

}  // namespace frangia
