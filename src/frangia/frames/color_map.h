#pragma once

#include <Eigen/Core>

namespace frangia {

enum class ColorMap {
  Gray,      ///< black to white: the saw-tooth of a wrapped phase reads best so
  Viridis,   ///< from dark blue to yellow: sizes
  Diverging  ///< from blue over white to red: deviations about zero
};

/// The colour of a value between 0 and 1; beyond, the end's colour.
///
/// units    red, green, blue from 0 to 1
/// missing  NaN is grey
[[nodiscard]] Eigen::Vector3f color_of(ColorMap map, float value);

}  // namespace frangia
