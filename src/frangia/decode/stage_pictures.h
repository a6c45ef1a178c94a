#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "frangia/core/image.h"
#include "frangia/frames/png.h"
#include "frangia/phase/wrap/phase_map.h"

namespace frangia {

/// Colour and caption of a pixel status.
struct StatusLegend {
  PixelStatus status;      ///< status that the entry explains
  Rgb color;               ///< color in `status_picture`
  std::string color_name;  ///< name of `color` for captions: "red"
  std::string meaning;     ///< short description of the status
};
/// One row per status, in the order of the enumeration.
[[nodiscard]] const std::vector<StatusLegend>& status_legend();

/// Draws pixel states in the colours of `status_legend`.
[[nodiscard]] Image<Rgb> status_picture(const Image<PixelStatus>& status);

/// Draws the wrapped phase from black to white with its residues: red squares around loops that
/// gain 2 pi clockwise, blue squares around loops that lose 2 pi.
[[nodiscard]] Image<Rgb> residue_picture(const Image<float>& wrapped_rad);

/// Draws the order of region growing from dark blue (seeds) to yellow (last pixel).
///
/// @missing  below 0
[[nodiscard]] Image<Rgb> growth_picture(const Image<std::int32_t>& order);

/// Draws labels, such as regions or fringe orders; consecutive labels get contrasting colours.
///
/// @missing  below 0
[[nodiscard]] Image<Rgb> label_picture(const Image<std::int32_t>& number);

/// Returns the fringe order of each pixel, counted from the lowest order in the view.
///
/// @missing  -1
[[nodiscard]] Image<std::int32_t> fringe_orders(const Image<float>& wrapped_rad,
                                                const Image<float>& absolute_rad);

}  // namespace frangia
