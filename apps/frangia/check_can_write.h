#pragma once

#include <filesystem>

#include "frangia/core/durable_file.h"

namespace frangia {

/// Checks before the work that a file can be written after it.
///
/// @errors   Error(File) when the folder does not exist or is not writable
inline void check_can_write(const std::filesystem::path& path) {
  const AtomicFile probe(path);
}

}  // namespace frangia
