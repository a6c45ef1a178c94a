#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "frangia/core/image.h"
#include "frangia/frames/png.h"
#include "frangia/phase/phase_map.h"

namespace frangia {

/// How a fate is drawn, and what to call it.
struct FateLegend {
  PixelFate fate;
  Rgb color;
  std::string color_name;
  std::string meaning;
};
/// A row a fate, in their order.
[[nodiscard]] const std::vector<FateLegend>& fate_legend();

/// Why each pixel went, in the colours of `fate_legend`.
[[nodiscard]] Image<Rgb> fate_picture(const Image<PixelFate>& fate);

/// The wrapped phase from black to white with its residues on it: red squares around loops that
/// gain a turn clockwise, blue ones around those that lose one.
[[nodiscard]] Image<Rgb> residue_picture(const Image<float>& wrapped_rad);

/// From dark blue, where each region's growth began, to yellow, where that of the largest ended.
[[nodiscard]] Image<Rgb> growth_picture(const Image<std::int32_t>& order);

/// Numbers such as those of regions or fringes, neighbouring ones in colours far apart; below 0 is
/// missing.
[[nodiscard]] Image<Rgb> number_picture(const Image<std::int32_t>& number);

/// The fringe that each pixel of a wrapped phase was given, from 0 for the lowest; -1 where
/// missing.
[[nodiscard]] Image<std::int32_t> fringe_numbers(const Image<float>& wrapped_rad,
                                                 const Image<float>& absolute_rad);

}  // namespace frangia
