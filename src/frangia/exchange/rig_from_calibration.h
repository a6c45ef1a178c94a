#pragma once

#include <array>
#include <optional>
#include <string>

#include "frangia/core/run.h"
#include "frangia/exchange/foreign_calibration.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// What files of other programs often leave out.
struct ImportRigOptions {
  std::optional<std::array<int, 2>> camera_size_px;     ///< width and height
  std::optional<std::array<int, 2>> projector_size_px;  ///< width and height
  std::optional<double> mm_per_unit;                    ///< unit of the translation
  /// Name of the second camera of a calibration of two cameras; empty: the second one is the
  /// projector. With a name, `camera_size_px` holds for both cameras, and the projector is a label
  /// of `projector_size_px`, or that of `base`.
  std::string second_camera;
  std::optional<Rig> base;  ///< supplies what the calibration does not state, such as the table
};

/// Makes a rig of a calibration of another program. `run` is warned of values that no device has:
/// focal lengths that differ along x and y, a field of a few degrees, distortion that displaces the
/// corners by two fifths, and devices that see no common point.
///
/// @errors   Error(Input) that names what is missing or impossible: a matrix with skew, a rotation
///          that is none, no image size, no projector, a baseline of 0
[[nodiscard]] Rig rig_from_calibration(const ForeignCalibration& calibration,
                                       const ImportRigOptions& options = {},
                                       const Run& run = {});

}  // namespace frangia
