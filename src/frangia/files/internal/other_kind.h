#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace frangia {

/// What a file is that begins with these bytes and that no reader of meshes takes whatever its
/// name, and what to do: "it is compressed by gzip; unpack it with gunzip". Empty for other bytes.
[[nodiscard]] std::string other_kind_of(std::string_view head);

/// As above, for the file; empty also where it cannot be read.
[[nodiscard]] std::string other_kind_of_file(const std::filesystem::path& path);

}  // namespace frangia
