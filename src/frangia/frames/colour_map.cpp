#include "frangia/frames/colour_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace frangia {
namespace {

constexpr Rgb kMissingColour{36, 40, 52};

/// Viridis (van der Walt & Smith 2015) at every eighth of its length.
constexpr std::array<std::array<double, 3>, 9> kViridis = {{{68, 1, 84},
                                                            {71, 44, 122},
                                                            {59, 81, 139},
                                                            {44, 113, 142},
                                                            {33, 144, 141},
                                                            {39, 173, 129},
                                                            {92, 200, 99},
                                                            {170, 220, 50},
                                                            {253, 231, 37}}};

}  // namespace

Rgb colour_of(double share, Palette palette) {
  const double place = std::clamp(share, 0.0, 1.0);
  if (palette == Palette::Grey) {
    const auto grey = static_cast<std::uint8_t>(std::lround(255.0 * place));
    return {grey, grey, grey};
  }
  const double position = place * static_cast<double>(kViridis.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(position), kViridis.size() - 2);
  const double mix = position - static_cast<double>(below);
  Rgb colour{};
  for (std::size_t channel = 0; channel < colour.size(); ++channel) {
    colour[channel] = static_cast<std::uint8_t>(
        std::lround((1.0 - mix) * kViridis[below][channel] + mix * kViridis[below + 1][channel]));
  }
  return colour;
}

ValueRange usual_range(const Image<float>& values) {
  std::vector<float> known;
  for (const float value : values.pixels()) {
    if (!std::isnan(value)) known.push_back(value);
  }
  if (known.empty()) return {};
  const auto at = [&](double share) {
    const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(known.size() - 1));
    std::nth_element(known.begin(), known.begin() + place, known.end());
    return known[static_cast<std::size_t>(place)];
  };
  return {at(0.01), at(0.99)};
}

Image<Rgb> picture_of(const Image<float>& values, ValueRange range, Palette palette) {
  Image<Rgb> picture(values.width(), values.height(), kMissingColour);
  const double width = std::max(range.high - range.low, 1e-12F);
  for (std::size_t i = 0; i < values.pixels().size(); ++i) {
    const float value = values.pixels()[i];
    if (!std::isnan(value)) picture.pixels()[i] = colour_of((value - range.low) / width, palette);
  }
  return picture;
}

}  // namespace frangia
