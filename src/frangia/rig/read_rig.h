#pragma once

#include <filesystem>

#include "frangia/core/run.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// A rig.toml, as docs/scan-format.md describes it. Keys it does not know are warned of by name.
///
/// errors   Error(Input) that names the file and the key: missing, of the wrong kind, not a finite
///          number, an unknown projector model, a rotation that is none
[[nodiscard]] Rig read_rig(const std::filesystem::path& path, const Run& run = {});

/// Writes a rig.toml that `read_rig` reads back to the same rig.
void write_rig(const std::filesystem::path& path, const Rig& rig);

}  // namespace frangia
