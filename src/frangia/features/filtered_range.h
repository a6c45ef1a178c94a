#pragma once

#include <vector>

#include <Eigen/Core>

namespace frangia {

/// A value at a point of a surface.
struct SurfaceValue {
  Eigen::Vector3d point_mm = Eigen::Vector3d::Zero();  ///< on the surface
  double value = 0.0;                                  ///< there, in any unit
};

/// The range of values without their noise.
struct FilteredRange {
  double low = 0.0;   ///< the least, in the unit of the values
  double high = 0.0;  ///< the largest
  /// Half the width of the 95 % interval of `high - low`: of both ends, and of how far the noise
  /// that remains draws the extremes of many blocks apart. Errors that are alike in neighbouring
  /// points are seen in parts of the blocks.
  double u95 = 0.0;
  std::vector<SurfaceValue> values;  ///< without their noise, in the order of the blocks
};

/// Replaces the values in compact blocks of at least 48 points by linear functions of the position
/// and returns the range of what remains. Fewer points are one block.
///
/// @errors   Error(Input) without values
[[nodiscard]] FilteredRange filtered_range(std::vector<SurfaceValue> values);

}  // namespace frangia
