#pragma once

#include <variant>

#include "frangia/core/run.h"
#include "frangia/rig/artifact.h"
#include "frangia/rig/board.h"
#include "frangia/rig/toml_reader.h"

namespace frangia {

/// What a `[board]` table describes.
using BoardOrArtifact = std::variant<Board, Artifact>;

/// Reads the `[board]` table of scan.toml.
///
/// @errors   Error(Input) that names the file and the key
[[nodiscard]] BoardOrArtifact read_board(TomlReader reader, const Run& run);

}  // namespace frangia
