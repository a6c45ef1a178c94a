#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace frangia {

/// A value at a point of a surface.
struct SurfaceValue {
  Eigen::Vector3d point_mm;
  double value = 0.0;
};

/// The range of values without their noise.
struct FilteredRange {
  double low = 0.0;
  double high = 0.0;
  double u95 = 0.0;  ///< of `high - low`, from the noise that the filter removed
};

/// Replaces the values in compact blocks of at least 48 points by linear functions of the position
/// and returns the range of what remains. Fewer points are one block.
///
/// @errors   Error(Input) without values
[[nodiscard]] FilteredRange filtered_range(std::vector<SurfaceValue> values);

}  // namespace frangia
