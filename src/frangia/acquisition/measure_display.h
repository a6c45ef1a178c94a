#pragma once

#include <optional>
#include <string>
#include <vector>

#include "frangia/acquisition/capture_options.h"
#include "frangia/core/run.h"
#include "frangia/devices/rig_devices.h"
#include "frangia/rig/fringe_waveform.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// What flashes, ramps and fringes show of a digital projector and the camera that looks at it.
struct DisplayMeasurement {
  double exposure_ms = 0.0;  ///< of most frames; bright pixels are below white

  double latency_s = 0.0;  ///< from the buffer swap until an exposure sees the whole new picture
  double delay_s = 0.0;    ///< `latency_s` with a margin, which was tried with three codes
  int late_frames = 0;     ///< by which frames come late, whatever the delay
  std::optional<int> skip_frames;  ///< of the camera, where frames come late
  double camera_fps = 0.0;         ///< frames a second of one picture, by the camera's clock
  double patterns_per_s = 0.0;     ///< shown and captured, with `delay_s`

  /// Frequency of the mains whose lamps light the room: 50 or 60; 0 where their light is steady, or
  /// flickers with neither.
  double mains_hz = 0.0;
  double room_flicker = 0.0;  ///< amplitude of the room's light, over the full light of the display
  /// Exposures of whole multiples see the same light of the room and of the display; 0: any do.
  double exposure_step_ms = 0.0;

  /// Of the display, light over level; empty where the light of the room hides it.
  std::optional<ResponseCurve> response;
  double sharpness = 0.0;   ///< contrast of fringes of 12 px over that of coarse ones, 0 to 1
  int white_level = 255;    ///< counts from which on the sensor is saturated
  double dark_zeros = 0.0;  ///< share of lit pixels at 0 counts while the display is dark

  std::vector<std::string>
      findings;  ///< what to correct, one sentence each; empty when all is good
};

/// Measures a digital projector and the camera on a bright even surface in front of both, such as a
/// sheet of paper: how late flashes of a code are seen, how the light of the room flickers, the
/// response, the sharpness of fringes, and the level at which pixels saturate. Nothing moves and
/// nothing is stored; all devices are safe when it returns or throws, and the display has its delay
/// again. `options.camera.exposure_ms` is where the search for an exposure begins.
///
/// @errors   Error(Input) for a rig without camera or digital projector; Error(Numeric) when too
///           few pixels are lit, or the flashes are not followed; those of the devices
[[nodiscard]] DisplayMeasurement measure_display(RigDevices& devices,
                                                 const Rig& rig,
                                                 const CaptureOptions& options = {},
                                                 const Run& run = {});

}  // namespace frangia
