#pragma once

#include <filesystem>
#include <string>

#include "frangia/core/durability.h"
#include "frangia/core/run.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// Reads a rig.toml; docs/scan-format.md describes the format. An unknown key is a warning that
/// names it.
///
/// @errors   Error(Input) that names the file and the key when a key is missing, of the wrong type
///          or not finite, when the projector model is unknown, or when a matrix is not a rotation
[[nodiscard]] Rig read_rig(const std::filesystem::path& path, const Run& run = {});

/// Returns the text of a rig.toml from which `read_rig` restores the same rig.
[[nodiscard]] std::string rig_text(const Rig& rig);

/// Writes `rig_text` to a file.
///
/// @errors   Error(File) when the file cannot be written
void write_rig(const std::filesystem::path& path,
               const Rig& rig,
               Durability durability = Durability::Buffered);

}  // namespace frangia
