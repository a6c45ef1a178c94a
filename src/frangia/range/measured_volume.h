#pragma once

#include <vector>

#include <Eigen/Core>

#include "frangia/core/image.h"

namespace frangia {

/// A place of the surface as the rig has it before it at two stations of the turntable. The normals
/// are one direction of the part.
struct SharedPlace {
  Eigen::Vector3d first_mm;       ///< at the first station
  Eigen::Vector3d first_normal;   ///< unit, towards the camera
  Eigen::Vector3d second_mm;      ///< at the second station
  Eigen::Vector3d second_normal;  ///< unit, towards the camera
};

/// What a scan measured, by some hundreds of places; all in the rig frame.
struct MeasuredVolume {
  std::vector<Eigen::Vector3d> points_mm;  ///< on all surfaces and from all views
  /// Empty for a single view. Registration places the axis of the turntable so that views agree
  /// there, whatever the rig does.
  std::vector<SharedPlace> shared;
};

/// Finds the smallest box that holds every pixel with a value. A part usually covers a small share
/// of the image, so later stages leave out the rest.
///
/// @missing  NaN; the box is empty when all pixels are missing
[[nodiscard]] PixelBox measured_box(const Image<float>& image);

}  // namespace frangia
