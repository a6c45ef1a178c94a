#pragma once

#include <variant>

#include "frangia/core/run.h"
#include "frangia/pattern/pattern.h"
#include "frangia/rig/artifact.h"
#include "frangia/rig/board.h"
#include "frangia/rig/rig.h"
#include "frangia/rig/toml_reader.h"

namespace frangia {

/// One `[[pattern]]` table of scan.toml. Unknown keys are warned of.
///
/// @errors   Error(Input) that names the key: missing, out of range, or not possible with `rig`
[[nodiscard]] Pattern read_pattern(TomlReader reader, const Rig& rig, const Run& run);

/// What a `[board]` table describes.
using BoardOrArtifact = std::variant<Board, Artifact>;

/// Reads the `[board]` table of scan.toml.
///
/// @errors   Error(Input) that names the file and the key
[[nodiscard]] BoardOrArtifact read_board(TomlReader reader, const Run& run);

}  // namespace frangia
