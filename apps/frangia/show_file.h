#pragma once

#include <filesystem>
#include <string>

namespace frangia {

/// Opens a file in the desktop's program for it, by xdg-open with its output silenced. Returns
/// whether that worked.
[[nodiscard]] bool show_file(const std::filesystem::path& path);

/// Opens an address that begins with "http://" in the desktop's browser, in the same way.
[[nodiscard]] bool show_address(const std::string& address);

}  // namespace frangia
