#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace frangia {

/// The place of the numbers of an accessor in its buffer.
struct GltfNumbers {
  std::string_view bytes;                  ///< from the first number on
  std::uint64_t count = 0;                 ///< of elements
  std::uint64_t stride = 0;                ///< from one element to the next, bytes
  std::uint64_t type = 0;                  ///< of a component, as the file states it
  double unit = 1.0;                       ///< divisor of the stored numbers
  const nlohmann::json* sparse = nullptr;  ///< what replaces single elements, or null
};

/// The JSON of a glTF file and its buffers, in memory.
struct GltfDocument {
  std::filesystem::path path;
  std::string bytes;  ///< of the file; of a .glb it includes the binary chunk
  nlohmann::json json;
  std::map<std::string, std::string> files;  ///< contents of the files and embedded buffers by uri
  std::vector<std::string_view> buffers;     ///< into `bytes` or `files`
  std::uint64_t total_bytes = 0;             ///< of the file and of the buffer files that it names

  GltfDocument() = default;
  GltfDocument(const GltfDocument&) = delete;  // the views of a copy refer to the original
  GltfDocument& operator=(const GltfDocument&) = delete;
  GltfDocument(GltfDocument&&) = delete;
  GltfDocument& operator=(GltfDocument&&) = delete;
  ~GltfDocument() = default;

  /// @errors   Error(Input) that names the file
  [[noreturn]] void fail(const std::string& why) const;

  /// The number of components of an element of an accessor: 1, 3 or 4; 0 for another shape.
  ///
  /// @errors   Error(Input) for an accessor that does not exist
  [[nodiscard]] std::size_t width_of(std::uint64_t accessor) const;
  /// Where the numbers of an accessor with `width` components per element are.
  ///
  /// @missing  `bytes` are empty where a sparse accessor begins as zeros
  /// @errors   Error(Input) for an accessor that does not exist, has another width, is compressed,
  ///          or exceeds its buffer
  [[nodiscard]] GltfNumbers locate(std::uint64_t accessor, std::size_t width) const;
  /// The numbers of an accessor with `width` components per element.
  ///
  /// @errors   Error(Input) as `locate`
  [[nodiscard]] std::vector<double> numbers(std::uint64_t accessor, std::size_t width) const;
  /// The bytes of the view that an accessor names, from its offset on, and their stride.
  ///
  /// @errors   Error(Input) unless they hold `count` elements
  [[nodiscard]] std::string_view bytes_of_view(const nlohmann::json& reference,
                                               std::uint64_t count,
                                               std::uint64_t element_bytes,
                                               std::uint64_t& stride) const;
  /// Sets the elements that a sparse accessor replaces.
  void replace_sparse(const GltfNumbers& place,
                      std::size_t width,
                      std::vector<double>& numbers) const;

  /// Whether a primitive has its positions in the Draco format, without a plain copy.
  [[nodiscard]] bool is_compressed(const nlohmann::json& primitive) const;
  /// Whether KHR_node_visibility hides a node, and with it what is below.
  [[nodiscard]] static bool hides(const nlohmann::json& node);

  /// Element `index` of a list of the document.
  ///
  /// @errors   Error(Input) when it does not exist
  [[nodiscard]] const nlohmann::json& item(const char* list, std::uint64_t index) const;

  /// A number of the document that counts or refers to something.
  ///
  /// @errors   Error(Input) unless it is whole and not negative; a number with a point is at most
  ///          2^53
  [[nodiscard]] std::uint64_t whole(const nlohmann::json& number) const;
  /// As `whole` for the value of a key, or `fallback` when the object has no such key.
  [[nodiscard]] std::uint64_t whole_or(const nlohmann::json& object,
                                       const char* key,
                                       std::uint64_t fallback) const;
  /// The numbers of a list, which is empty when the object has no such key.
  [[nodiscard]] std::vector<std::uint64_t> whole_list(const nlohmann::json& object,
                                                      const char* key) const;
};

/// Reads a .gltf or .glb with all of its buffers. A file that several buffers name is read once.
///
/// @errors   Error(Input) that names the file: invalid JSON, chunks or buffers that are truncated,
///          a buffer that is neither embedded nor a file below the same folder
void read_gltf_document(const std::filesystem::path& path, GltfDocument& document);

}  // namespace frangia
