#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "frangia/calibrate/artifact/calibrate_artifacts.h"

namespace frangia {

/// Writes a calibration by a screen, plates and balls as one HTML file without references to other
/// files: parameters and grade, the residuals of the screen over the image, and the distances of
/// the measured points from plates and balls over the image and by view, in millimetres.
///
/// @errors   Error(File) when the file cannot be written
void write_artifact_report(const std::filesystem::path& path,
                           const ArtifactCalibration& result,
                           std::span<const std::string> warnings = {});

}  // namespace frangia
