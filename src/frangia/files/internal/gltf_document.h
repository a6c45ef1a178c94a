#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace frangia {

/// The JSON of a glTF file and its buffers, in memory.
struct GltfDocument {
  std::filesystem::path path;
  nlohmann::json json;
  std::vector<std::string> buffers;

  /// @errors   Error(Input) that names the file
  [[noreturn]] void fail(const std::string& why) const;

  /// The numbers of an accessor with `width` components per element.
  ///
  /// @errors   Error(Input) for an accessor that does not exist, has another width, is sparse, or
  ///          exceeds its buffer
  [[nodiscard]] std::vector<double> numbers(std::uint64_t accessor, std::size_t width) const;

  /// Element `index` of a list of the document.
  ///
  /// @errors   Error(Input) when it does not exist
  [[nodiscard]] const nlohmann::json& item(const char* list, std::uint64_t index) const;
};

/// Reads a .gltf or .glb with all of its buffers.
///
/// @errors   Error(Input) that names the file: invalid JSON, chunks or buffers that are truncated,
/// a
///          buffer that is neither embedded nor in a file beside it
[[nodiscard]] GltfDocument read_gltf_document(const std::filesystem::path& path);

}  // namespace frangia
