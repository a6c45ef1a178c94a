#pragma once

#include <filesystem>
#include <stop_token>

namespace frangia {

/// Opens a file in the desktop's program for it, by xdg-open with its output silenced. Without a
/// desktop xdg-open ends with that program: waits until then, or until `stop`. Returns whether it
/// worked.
[[nodiscard]] bool show_file(const std::filesystem::path& path, const std::stop_token& stop = {});

}  // namespace frangia
