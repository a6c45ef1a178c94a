#pragma once

#include <filesystem>

#include "frangia/exchange/foreign_calibration.h"

namespace frangia {

/// Reads the first camera of a cameras.txt of COLMAP, and the second as projector. COLMAP's first
/// pixel has its centre at (0.5, 0.5).
///
/// @errors   Error(Input) that names the file and the line
[[nodiscard]] ForeignCalibration read_colmap_cameras(const std::filesystem::path& file);

}  // namespace frangia
