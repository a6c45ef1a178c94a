#pragma once

#include <optional>
#include <span>
#include <vector>

#include "frangia/acquisition/capture_options.h"
#include "frangia/core/run.h"
#include "frangia/devices/rig_devices.h"
#include "frangia/pattern/pattern.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// Chooses exposures by the finest fringes of `patterns` on the part as it stands. The turntable
/// turns to `table_rad` where that is given and its home switch finds the angle; otherwise it does
/// not move. `options.exposure` is Automatic for the longest exposure without saturation, or
/// Bracketed for several of them, the one that measures most first. Nothing is stored. All devices
/// are safe when it returns or throws.
///
/// @units    ms
/// @errors   Error(Input) for rigs without camera or fringes, without a pattern of fringes, or for
///           exposures that are given; those of the devices
[[nodiscard]] std::vector<double> find_exposures(RigDevices& devices,
                                                 const Rig& rig,
                                                 std::span<const Pattern> patterns,
                                                 const CaptureOptions& options,
                                                 std::optional<double> table_rad = {},
                                                 const Run& run = {});

}  // namespace frangia
