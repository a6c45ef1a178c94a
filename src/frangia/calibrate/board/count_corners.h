#pragma once

#include <array>
#include <optional>

#include "frangia/core/image.h"

namespace frangia {

/// Counts the inner corners of the largest checkerboard in an image, along its two sides.
///
/// It serves messages: it states what a picture shows when the expected board is not found. A board
/// that the image cuts off counts with the corners that are seen.
/// @units    counts
/// @missing  nothing when the image shows no checkerboard of 4 x 3 corners or more
/// @source   Duda & Frese 2018; OpenCV
[[nodiscard]] std::optional<std::array<int, 2>> count_corners(const Image<float>& counts);

}  // namespace frangia
