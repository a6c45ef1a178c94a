#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "frangia/core/image.h"
#include "frangia/frames/png.h"
#include "frangia/phase/phase_map.h"

namespace frangia {

/// How a status is drawn, and what to call it.
struct StatusLegend {
  PixelStatus status;
  Rgb color;
  std::string color_name;
  std::string meaning;
};
/// A row a status, in their order.
[[nodiscard]] const std::vector<StatusLegend>& status_legend();

/// Why each pixel went, in the colours of `status_legend`.
[[nodiscard]] Image<Rgb> status_picture(const Image<PixelStatus>& status);

/// The wrapped phase from black to white with its residues on it: red squares around loops that
/// gain a turn clockwise, blue ones around those that lose one.
[[nodiscard]] Image<Rgb> residue_picture(const Image<float>& wrapped_rad);

/// From dark blue, where each region's growth began, to yellow, where that of the largest ended.
[[nodiscard]] Image<Rgb> growth_picture(const Image<std::int32_t>& order);

/// Numbers such as those of regions or fringes, neighbouring ones in colours far apart; below 0 is
/// missing.
[[nodiscard]] Image<Rgb> label_picture(const Image<std::int32_t>& number);

/// The fringe that each pixel of a wrapped phase was given, from 0 for the lowest; -1 where
/// missing.
[[nodiscard]] Image<std::int32_t> fringe_orders(const Image<float>& wrapped_rad,
                                                const Image<float>& absolute_rad);

}  // namespace frangia
