#pragma once

#include <filesystem>
#include <string>

namespace frangia {

/// A file name's extension in lower case, with its point: ".stl" of "Part.STL"; empty without one.
[[nodiscard]] inline std::string lowercase_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

}  // namespace frangia
