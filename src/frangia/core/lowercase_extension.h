#pragma once

#include <filesystem>
#include <string>

namespace frangia {

/// The extension of a file name in lower case, with its dot: ".stl" for "Part.STL". Empty when the
/// name has no extension.
[[nodiscard]] inline std::string lowercase_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

}  // namespace frangia
