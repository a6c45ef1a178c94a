#pragma once

#include "frangia/devices/driver_registry.h"

namespace frangia {

/// Adds the driver "simulated" of every kind. All of them share one bench: the camera sees what the
/// others did. Their settings in rig.toml:
///
///     [devices.camera]         part = "bracket" or a mesh file, seed, samples, ambient, contrast,
///                              gloss, shininess, texture, speckle, reference_exposure_ms,
///                              faults = ["lost 1 fringe 2", "incomplete ...", "saturated 2",
///                                        "motion 1 fringe", "unplugged 3"]   KIND VIEW PATTERN
///                                        FRAME
///     [devices.phase_shifter]  fringes_per_degree, degrees_per_volt, gain_error, hysteresis_v,
///                              drift_deg_per_view, jitter_deg, time_constant_ms, settle_ms
///     [devices.turntable]      backlash_deg, approach_deg, limits_deg,
///                              faults = ["stuck 90", "alarm 90"]             KIND ANGLE ["always"]
///     [devices.pattern_display], [devices.line_source], [devices.lamp], [devices.laser]
///
/// The lost and incomplete frame, and the stuck table, are well at the second attempt.
/// errors   as make_simulated_scene; Error(Input) for a fault that is not known
void add_simulated_drivers(DriverRegistry& registry);

}  // namespace frangia
