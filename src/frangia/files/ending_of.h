#pragma once

#include <filesystem>
#include <string>

namespace frangia {

/// A file name's ending in lower case, with its point: ".stl" of "Part.STL"; empty without one.
[[nodiscard]] inline std::string ending_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return ending;
}

}  // namespace frangia
