#pragma once

#include "frangia/acquisition/internal/display_probe.h"

namespace frangia {

/// Light of the room while the display is dark.
struct RoomLight {
  bool flickers = false;   ///< by more than the scatter of the frames
  double mains_hz = 0.0;   ///< 50 or 60; 0: steady, or of another frequency
  double amplitude = 0.0;  ///< of the light that varies, over `full_light`
};

/// Share of a light's flicker that an exposure leaves; 1 for an unknown frequency of 0.
///
/// @source   the mean of a sine over an interval, sin(x) / x
[[nodiscard]] double flicker_left(double exposure_ms, double light_hz);

/// Compares frames of three exposures: over whole periods of 1/100 s or 1/120 s the light is even.
/// Leaves the camera at one of them and the display dark, with another delay.
///
/// @units    full_light: of the display, counts a ms; exposure_ms: at which its pictures are bright
[[nodiscard]] RoomLight measure_room_light(DisplayProbe& probe,
                                           const LitPixels& lit,
                                           double full_light,
                                           double exposure_ms);

/// Shortest exposure of whole periods of both, in which they agree within 1 %; the first one where
/// there is none up to six of them. 0 for a light that is steady.
///
/// @units    ms
[[nodiscard]] double common_period_ms(double refresh_ms, double room_ms);

}  // namespace frangia
