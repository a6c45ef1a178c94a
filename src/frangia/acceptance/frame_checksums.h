#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "frangia/core/run.h"

namespace frangia {

/// Checksums of a scan's files.
struct FrameChecksums {
  std::string list;       ///< a line a file, in the format of `sha256sum`
  std::string sha256;     ///< of the list, hexadecimal
  std::size_t files = 0;  ///< lines of the list
};

/// Checksums of rig.toml, scan.toml and all files of the views of a scan folder, sorted by name.
///
/// @errors   Error(Input) that names a file which cannot be read; Error(Cancelled)
[[nodiscard]] FrameChecksums frame_checksums(const std::filesystem::path& scan,
                                             const Run& run = {});

}  // namespace frangia
