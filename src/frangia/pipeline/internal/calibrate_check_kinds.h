#pragma once

#include "frangia/pipeline/calibrate_check.h"

namespace frangia {

/// Adds the figures of balls of known sizes on the turntable to a check.
void check_balls_of(const Scan& scan,
                    const Rig& rig,
                    const CheckRigOptions& options,
                    const Run& run,
                    RigCheck& check);

/// Likewise of a plate: its flatness, and how far the views disagree.
void check_plate_of(const Scan& scan,
                    const Rig& rig,
                    const CheckRigOptions& options,
                    const Run& run,
                    RigCheck& check);

/// Likewise of any part: how far the views disagree.
void check_part_of(const Scan& scan,
                   const Rig& rig,
                   const CheckRigOptions& options,
                   const Run& run,
                   RigCheck& check);

}  // namespace frangia
