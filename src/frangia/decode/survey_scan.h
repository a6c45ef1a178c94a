#pragma once

#include <map>
#include <optional>
#include <string>

#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/frames/noise_model.h"

namespace frangia {

/// Properties that all views share and that several views determine better than one.
struct ScanSurvey {
  std::optional<NoiseModel>
      noise;  ///< of the camera, estimated from frames; empty when rig.toml gives it
  std::map<std::string, double> gain_error;  ///< of the phase shifter, relative, by pattern name
};

/// Estimates the camera's noise, unless rig.toml gives it, and the gain error of a phase shifter,
/// from the fringe frames of several views, evenly over the scan.
///
/// @missing  both are empty for a scan of one view, whose decoding estimates them itself
/// @errors   as read_frames
[[nodiscard]] ScanSurvey survey_scan(const Scan& scan, const Run& run = {});

}  // namespace frangia
