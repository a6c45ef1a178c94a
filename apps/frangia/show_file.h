#pragma once

#include <filesystem>

namespace frangia {

/// Opens a file in the desktop's program for it, by xdg-open with its output silenced. Returns
/// whether that worked.
[[nodiscard]] bool show_file(const std::filesystem::path& path);

}  // namespace frangia
