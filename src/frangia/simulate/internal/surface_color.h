#pragma once

#include <Eigen/Core>

namespace frangia {

/// Reflectance of a coloured surface in red, green and blue: bands of changing hue. Each channel
/// varies from 1 to 1 - strength as a sine along a skew direction, with a period of 40 mm and a
/// third of a period between the channels.
///
/// @units    mm, frame of the part
[[nodiscard]] Eigen::Vector3d surface_color(const Eigen::Vector3d& position_mm, double strength);

/// The share of light that a grey camera sees of a color.
///
/// @source   ITU-R BT.601
[[nodiscard]] double luminance_of_color(const Eigen::Vector3d& color);

}  // namespace frangia
