#pragma once

#include <filesystem>
#include <string_view>

#include "frangia/core/durability.h"

namespace frangia {

/// Replaces a file in one step: a reader sees either all of the old bytes or all of the new ones.
/// `text` may hold any bytes.
///
/// @errors   Error(File) when it cannot be written, see AtomicFile
void write_text_file(const std::filesystem::path& path,
                     std::string_view text,
                     Durability durability = Durability::Buffered);

}  // namespace frangia
