#pragma once

#include <span>

#include "frangia/acquisition/internal/capture_devices.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/pattern/pattern.h"
#include "frangia/phase/wrap/phase_map.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// Captures the frames of the finest fringes of `patterns` at an exposure, where the turntable
/// stands.
///
/// @errors   Error(Input) without a pattern of fringes, and those of the devices
[[nodiscard]] FrameStack capture_finest(std::span<const Pattern> patterns,
                                        const Rig& rig,
                                        int view,
                                        CaptureDevices& devices,
                                        double exposure_ms);

/// Captures the finest fringes of `patterns` at an exposure, where the turntable stands, and
/// returns the state of each pixel.
///
/// @errors   Error(Input) without a pattern of fringes, and those of the devices
[[nodiscard]] Image<PixelStatus> probe_exposure(std::span<const Pattern> patterns,
                                                const Rig& rig,
                                                int view,
                                                CaptureDevices& devices,
                                                double exposure_ms);

}  // namespace frangia
