#pragma once

#include <cstddef>

#include "frangia/calibrate/check/calibrate_check.h"

namespace frangia {

/// Which camera of a rig a figure concerns; it counts as in `rig_of_camera`.
struct CheckedCamera {
  const Rig& whole;        ///< the rig with all cameras and its covariance
  std::size_t camera = 0;  ///< 0: the reference camera
};

/// Adds the figures of balls of known sizes on the turntable to a check. `scan` and its rig are
/// those of one camera, see `scan_of_camera`.
void check_balls_of(const Scan& scan,
                    const CheckRigOptions& options,
                    const CheckedCamera& camera,
                    const Run& run,
                    RigCheck& check);

/// Likewise of a plate: its flatness, and how far the views disagree.
void check_plate_of(const Scan& scan,
                    const CheckRigOptions& options,
                    const CheckedCamera& camera,
                    const Run& run,
                    RigCheck& check);

/// Likewise of any part: how far the views disagree.
void check_part_of(const Scan& scan,
                   const CheckRigOptions& options,
                   const CheckedCamera& camera,
                   const Run& run,
                   RigCheck& check);

/// Adds how far the surfaces of each further camera disagree with those of the reference camera in
/// the same views, whatever they show. `scan` and its rig are those of all cameras.
///
/// @errors   Error(Numeric) when two cameras share too few points
void check_cameras_of(const Scan& scan,
                      const CheckRigOptions& options,
                      const Run& run,
                      RigCheck& check);

}  // namespace frangia
