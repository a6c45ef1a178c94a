#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace frangia {

/// A glTF's JSON and its buffers, whole and in memory.
struct GltfDocument {
  std::filesystem::path path;
  nlohmann::json json;
  std::vector<std::string> buffers;

  /// errors   Error(Input) that names the file
  [[noreturn]] void fail(const std::string& why) const;

  /// The numbers of an accessor, `width` to an element.
  ///
  /// errors   Error(Input): no such accessor, one of another width, sparse, or beyond its buffer
  [[nodiscard]] std::vector<double> numbers(std::uint64_t accessor, std::size_t width) const;

  /// Item `index` of a list of the document.
  [[nodiscard]] const nlohmann::json& item(const char* list, std::uint64_t index) const;
};

/// errors   Error(Input) that names the file: JSON that is none, chunks or buffers that are cut
///          short or lie elsewhere
[[nodiscard]] GltfDocument read_gltf_document(const std::filesystem::path& path);

}  // namespace frangia
