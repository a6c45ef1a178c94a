#pragma once

#include <map>
#include <optional>
#include <string>

#include "frangia/core/run.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/frames/noise_model.h"

namespace frangia {

/// What is the same in all views of a scan, and better known from several than from one.
struct ScanSurvey {
  std::optional<NoiseModel> noise;           ///< the camera's, from the frames
  std::map<std::string, double> gain_error;  ///< the phase shifter's, by pattern
};

/// Looks at the fringe frames of some views, evenly over the scan: for the camera's noise where
/// rig.toml does not give it, and for the phase shifter's gain where the projector has one. A scan
/// of a single view is not looked at: its own decoding finds the same.
///
/// errors   Error(Input) as `read_frames`
[[nodiscard]] ScanSurvey survey_scan(const Scan& scan, const Run& run = {});

}  // namespace frangia
