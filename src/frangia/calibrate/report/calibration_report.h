#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "frangia/calibrate/solve/calibrate_rig.h"

namespace frangia {

/// Writes a calibration as one HTML file without references to other files: parameters, residuals
/// by pose and over the images of camera and projector, coverage, and the boards as they were
/// found. `calibrate_rig` must have run with `keep_pictures` for the latter.
///
/// @errors   Error(File) when the file cannot be written
void write_calibration_report(const std::filesystem::path& path,
                              const RigCalibration& result,
                              const Board& board,
                              std::span<const std::string> warnings = {});

}  // namespace frangia
