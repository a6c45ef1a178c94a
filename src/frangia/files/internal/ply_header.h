#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frangia {

enum class PlyFormat { Ascii, LittleEndian, BigEndian };
enum class PlyType { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::Float32;    ///< of the value, or of the elements of a list
  std::optional<PlyType> count_type;  ///< of the length of a list; empty for a single value
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::Ascii;
  std::vector<PlyElement> elements;
  std::size_t body = 0;  ///< offset of the first element in the file, bytes
};

/// Parses the header of a PLY file.
///
/// @errors   Error(Input) that names the file and the line
[[nodiscard]] PlyHeader parse_ply_header(const std::filesystem::path& path, std::string_view bytes);

/// Size of a number, bytes.
[[nodiscard]] std::size_t bytes_of(PlyType type);

}  // namespace frangia
