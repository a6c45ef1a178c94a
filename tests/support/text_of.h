#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace frangia::testing {

/// All that a file holds.
inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace frangia::testing
