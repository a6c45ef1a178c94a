#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>

#include "frangia/core/error.h"

namespace frangia {

/// The first of "Bust", "Bust 2", ... that a folder does not hold.
[[nodiscard]] std::filesystem::path free_name(const std::filesystem::path& folder,
                                              const std::string& name);

/// Renames a folder, and waits until the disk has its new name.
///
/// @errors   Error(File) that names the folder
void move_folder(const std::filesystem::path& from, const std::filesystem::path& to);

/// Does work with a file that arrived under a name of the server's own: an error of it names the
/// file as people know it. An empty name changes nothing.
template <typename Work>
auto naming(const std::filesystem::path& file, const std::string& name, const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    if (name.empty() || error.kind() == ErrorKind::Cancelled) throw;
    std::string text = error.what();
    for (const std::string& own : {file.string(), file.filename().string()}) {
      for (std::size_t at = text.find(own); at != std::string::npos;
           at = text.find(own, at + name.size()))
        text.replace(at, own.size(), name);
    }
    throw Error(error.kind(), text);
  }
}

/// The present time as files of a project state it.
inline std::int64_t seconds_since_1970() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::seconds>(now).count();
}

}  // namespace frangia
