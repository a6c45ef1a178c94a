#pragma once

#include <filesystem>
#include <string_view>

#include "frangia/core/durability.h"

namespace frangia {

/// Writes a whole file at once: whoever reads it has the old bytes or the new ones. What `text`
/// holds need not be text.
///
/// @errors   Error(File) when it cannot be written, see AtomicFile
void write_text_file(const std::filesystem::path& path,
                     std::string_view text,
                     Durability durability = Durability::Buffered);

}  // namespace frangia
