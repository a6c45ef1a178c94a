#pragma once

#include "frangia/acquisition/capture_options.h"
#include "frangia/acquisition/internal/capture_devices.h"
#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/frames/frame_stack.h"

namespace frangia {

/// How far fringes moved between two captures of the same frames of a scene at rest: the phase of
/// each of 8 x 8 fields of the image, root mean square over those with light.
///
/// @units    rad
/// @missing  NaN where no field has light
/// @errors   Error(Input) when the frames differ in number or size
[[nodiscard]] double fringe_motion_rad(const FrameStack& before, const FrameStack& after);

/// Distance between two fringes of a pattern at the axis of the turntable.
///
/// @units    mm
/// @errors   Error(Input) for a rig without a turntable, whose distance is not known
[[nodiscard]] double fringe_distance_mm(const Pattern& pattern, const Rig& rig);

/// Looks at the finest fringes, where the turntable stands, until they move by less than
/// `drift_limit_mm` between two looks, twice in a row. Returns the last motion.
///
/// @units    mm at the part
/// @errors   Error(Device) when they still move after `drift_patience_s`; Error(Cancelled); those
/// of
///           the devices
[[nodiscard]] double wait_for_drift(const Scan& plan,
                                    CaptureDevices& devices,
                                    const CaptureOptions& options,
                                    double exposure_ms,
                                    const Run& run);

}  // namespace frangia
