#pragma once

#include <filesystem>
#include <string_view>

#include "frangia/core/durability.h"

namespace frangia {

/// Writes a file that its owner alone may read and write: mode 0600 from its creation on, whatever
/// it replaces. It appears complete, as AtomicFile; for a moment, a new one is empty.
///
/// @errors   Error(File) as AtomicFile
void write_private_file(const std::filesystem::path& path,
                        std::string_view text,
                        Durability durability = Durability::Buffered);

}  // namespace frangia
