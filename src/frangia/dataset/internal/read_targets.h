#pragma once

#include "frangia/core/run.h"
#include "frangia/rig/target_set.h"
#include "frangia/rig/toml_reader.h"

namespace frangia {

/// Reads the `[targets]` table of scan.toml, without `check_targets`.
///
/// @errors   Error(Input) that names the key
[[nodiscard]] TargetSet read_targets(TomlReader reader, const Run& run);

}  // namespace frangia
