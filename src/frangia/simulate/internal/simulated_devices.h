#pragma once

#include <memory>

#include "frangia/devices/camera_device.h"
#include "frangia/devices/device.h"
#include "frangia/devices/device_settings.h"
#include "frangia/devices/pattern_display.h"
#include "frangia/devices/phase_shifter.h"
#include "frangia/devices/turntable_device.h"
#include "frangia/simulate/internal/simulated_bench.h"

namespace frangia {

using BenchPtr = std::shared_ptr<SimulatedBench>;

/// A ray-traced camera; places the part that the settings name on the bench.
///
/// @errors   Error(Input) that names file and key, or as make_simulated_scene
[[nodiscard]] std::unique_ptr<CameraDevice> open_simulated_camera(DeviceSettings& settings,
                                                                  const Rig& rig,
                                                                  BenchPtr bench);

/// A piezo with gain error, hysteresis, lag, drift and jitter.
[[nodiscard]] std::unique_ptr<PhaseShifter> open_simulated_piezo(DeviceSettings& settings,
                                                                 BenchPtr bench);

/// A digital projector of the rig's size.
[[nodiscard]] std::unique_ptr<PatternDisplay> open_simulated_display(DeviceSettings& settings,
                                                                     const Rig& rig,
                                                                     BenchPtr bench);

/// A table with backlash, soft limits and a home switch.
[[nodiscard]] std::unique_ptr<TurntableDevice> open_simulated_table(DeviceSettings& settings,
                                                                    BenchPtr bench);

/// A switch for one light of the bench.
[[nodiscard]] std::unique_ptr<SwitchDevice> open_simulated_switch(BenchPtr bench,
                                                                  bool SimulatedBench::*light);

}  // namespace frangia
