#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace frangia {

/// Reads a whole file. A named pipe, a device, a socket or a folder is refused at once and by its
/// kind; opening a pipe would block.
///
/// @errors   Error(Input) that names the path: missing, not a regular file, not readable, larger
///          than `max_bytes`, or a name with a NUL character
[[nodiscard]] std::vector<char> read_regular_file(const std::filesystem::path& path,
                                                  std::size_t max_bytes = SIZE_MAX);

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
