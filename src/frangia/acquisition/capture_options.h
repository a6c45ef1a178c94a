#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "frangia/devices/camera_device.h"

namespace frangia {

/// Who says how long the frames are exposed.
enum class ExposureChoice {
  Given,      ///< `camera.exposure_ms`, or each pattern's `exposures_ms`
  Automatic,  ///< one exposure, as long as it may be before too much is saturated
  Bracketed   ///< as many exposures as the part needs, for parts that shine
};

struct CaptureOptions {
  CameraSettings camera;  ///< `exposure_ms` is the first guess of the automatic ones
  ExposureChoice exposure = ExposureChoice::Given;
  bool control_steps = true;      ///< the steps that a set shows correct the next set's commands
  int frame_attempts = 50;        ///< of frames that arrive incomplete
  int set_attempts = 3;           ///< a set that shows motion is taken again
  int view_attempts = 2;          ///< after a device's fault
  double settle_s = 0.0;          ///< after a move of the table, besides the table's own
  double timeout_s = 10.0;        ///< for each call to a device, beyond the exposure
  double move_timeout_s = 120.0;  ///< for a move of the table
};

struct CaptureReport {
  std::size_t captured = 0;          ///< frames stored in this session
  std::size_t resumed = 0;           ///< frames that lay there already
  std::size_t frame_retries = 0;     ///< incomplete frames taken again, in all sessions
  std::size_t set_retakes = 0;       ///< sets that showed motion, in all sessions
  std::vector<std::string> skipped;  ///< views, each with why
  std::vector<double> exposures_ms;  ///< what the fringes were taken at
  double device_s = 0.0;             ///< spent in the devices: exposing, settling, moving
  double disk_s = 0.0;   ///< spent waiting for the disk to have what it was given (fsync)
  double other_s = 0.0;  ///< the program's own time on the way

  /// The program's own time for each frame taken.
  [[nodiscard]] double overhead_ms() const {
    return captured == 0 ? 0.0 : 1000.0 * other_s / static_cast<double>(captured);
  }
};

}  // namespace frangia
