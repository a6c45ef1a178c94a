#pragma once

#include <filesystem>
#include <stop_token>
#include <string>

namespace frangia {

/// Opens a file in the desktop's program for it, by xdg-open with its output silenced. Returns
/// whether that worked.
[[nodiscard]] bool show_file(const std::filesystem::path& path);

/// Opens an address that begins with "http://" or "https://" in the desktop's browser, in the same
/// way. Without a desktop xdg-open ends with the browser: waits until then, or until `stop`.
[[nodiscard]] bool show_address(const std::string& address, const std::stop_token& stop);

}  // namespace frangia
