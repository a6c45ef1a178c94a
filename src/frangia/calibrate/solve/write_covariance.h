#pragma once

#include <filesystem>

#include "frangia/calibrate/solve/solve_rig.h"

namespace frangia {

/// Writes the covariance of a solution as CSV: a line with the names of the parameters, then one
/// line per parameter with its name, its covariances and nothing else. docs/calibration.md defines
/// the parameters.
///
/// @units    those that end the names
/// @errors   Error(File) when the file cannot be written
void write_covariance(const std::filesystem::path& path, const RigSolution& solution);

}  // namespace frangia
