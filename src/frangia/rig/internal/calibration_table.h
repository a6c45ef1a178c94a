#pragma once

#include <string>

#include "frangia/core/run.h"
#include "frangia/rig/calibration.h"
#include "frangia/rig/toml_reader.h"

namespace frangia {

/// Reads the `[calibration]` table of rig.toml; every key is optional.
[[nodiscard]] Calibration read_calibration(TomlReader reader, const Run& run);

/// The `[calibration]` table as text.
[[nodiscard]] std::string toml_of(const Calibration& calibration);

}  // namespace frangia
