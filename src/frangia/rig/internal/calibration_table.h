#pragma once

#include "frangia/core/run.h"
#include "frangia/rig/calibration.h"
#include "frangia/rig/toml_reader.h"
#include "frangia/rig/toml_writer.h"

namespace frangia {

/// Reads the `[calibration]` table of rig.toml; every key is optional.
[[nodiscard]] Calibration read_calibration(TomlReader reader, const Run& run);

/// Writes the `[calibration]` table.
void put_calibration(TomlWriter& writer, const Calibration& calibration);

}  // namespace frangia
