#pragma once

#include <cstddef>

#include "frangia/calibrate/check/calibrate_check.h"

namespace frangia {

/// Which camera of a rig a figure concerns; it counts as in `rig_of_camera`.
struct CheckedCamera {
  const Rig& whole;        ///< the rig with all cameras and its covariance
  std::size_t camera = 0;  ///< 0: the reference camera
};

/// The figures of balls of known sizes on the turntable. `scan` and its rig are those of one
/// camera, see `scan_of_camera`.
[[nodiscard]] RigCheck check_balls_of(const Scan& scan,
                                      const CheckRigOptions& options,
                                      const CheckedCamera& camera,
                                      const Run& run);

/// Likewise of a plate: its flatness, and how far the views disagree.
[[nodiscard]] RigCheck check_plate_of(const Scan& scan,
                                      const CheckRigOptions& options,
                                      const CheckedCamera& camera,
                                      const Run& run);

/// Likewise of any part: how far the views disagree.
[[nodiscard]] RigCheck check_part_of(const Scan& scan,
                                     const CheckRigOptions& options,
                                     const CheckedCamera& camera,
                                     const Run& run);

/// How far the surfaces of each further camera disagree with those of the reference camera in
/// the same views, whatever they show. `scan` and its rig are those of all cameras.
///
/// @errors   Error(Numeric) when two cameras share too few points
[[nodiscard]] RigCheck check_cameras_of(const Scan& scan,
                                        const CheckRigOptions& options,
                                        const Run& run);

/// Both checks together.
[[nodiscard]] RigCheck joined(RigCheck check, const RigCheck& other);

}  // namespace frangia
