#pragma once

#include <string>

#include "frangia/calibrate/report/residual_maps.h"

namespace frangia {

/// Color of an error relative to a large one: green, yellow, red.
[[nodiscard]] std::string color_of(double share);

/// Arrows of all residuals over an image, as a figure with a caption.
[[nodiscard]] std::string residual_figure(const ResidualMap& map);

}  // namespace frangia
