#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace frangia {

/// Reads a whole file. A named pipe, a device, a socket or a folder is refused at once and by its
/// kind; opening a pipe would block.
///
/// @errors   Error(Input) that names the path: missing, not a regular file, not readable, larger
///          than `max_bytes`, or a name with a NUL character
[[nodiscard]] std::vector<char> read_regular_file(const std::filesystem::path& path,
                                                  std::size_t max_bytes = SIZE_MAX);

}  // namespace frangia
