#pragma once

#include <span>

#include <Eigen/Core>

#include "frangia/rig/rig.h"

namespace frangia {

/// A laser sheet and how well the points of its line fit it.
struct SheetFit {
  LaserSheet sheet;
  double rms_mm = 0.0;     ///< of the points that are not outliers
  std::size_t points = 0;  ///< that are not outliers
};

/// Fits a laser sheet to points of its line, up to half of which may be of something else. The
/// normal points as that of `start`.
///
/// @units    mm
/// @missing  no points where fewer than half of them, or ten, agree
/// @source   least median of squares, Rousseeuw 1984, then least squares of what lies near
[[nodiscard]] SheetFit fit_sheet(std::span<const Eigen::Vector3d> points, const LaserSheet& start);

}  // namespace frangia
