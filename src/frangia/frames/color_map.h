#pragma once

#include <Eigen/Core>

namespace frangia {

/// Colors for the values of a map.
enum class ColorMap {
  Gray,      ///< black to white, for wrapped phase
  Viridis,   ///< dark blue to yellow, for magnitudes
  Diverging  ///< blue over white to red, for signed deviations
};

/// Returns the colour of a value between 0 and 1. Values outside this range get the colour of the
/// nearer end.
///
/// @units    red, green, blue from 0 to 1
/// @missing  NaN is grey
[[nodiscard]] Eigen::Vector3f color_of(ColorMap map, float value);

}  // namespace frangia
