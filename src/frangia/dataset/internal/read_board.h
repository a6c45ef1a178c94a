#pragma once

#include "frangia/core/run.h"
#include "frangia/rig/board.h"
#include "frangia/rig/toml_reader.h"

namespace frangia {

/// Reads the `[board]` table of scan.toml.
///
/// @errors   Error(Input) that names the file and the key
[[nodiscard]] Board read_board(TomlReader reader, const Run& run);

}  // namespace frangia
