#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace frangia {

/// The largest text file that is read whole, bytes. The scan.toml of 10 000 views has 1 MB; a
/// parsed file takes up to 100 times its size in memory.
inline constexpr std::uint64_t kMaxTextFileBytes = 8'000'000;

/// Reads a whole regular file of at most `max_bytes`, without changing its bytes. It never waits
/// for a pipe or a device.
///
/// @errors   Error(Input) that names the file: it does not exist, is not a regular file, is larger
///          than `max_bytes`, or cannot be read
[[nodiscard]] std::string read_text_file(const std::filesystem::path& file,
                                         std::uint64_t max_bytes = kMaxTextFileBytes);

}  // namespace frangia
