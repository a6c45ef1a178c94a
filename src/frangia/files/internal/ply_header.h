#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/files/internal/text_reader.h"

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

/// Reads the values of an ascii PLY in order.
class AsciiPlySource {
 public:
  AsciiPlySource(const std::filesystem::path& path, std::string_view bytes, std::size_t body)
      : reader_(path, bytes) {
    while (reader_.position() < body)
      reader_.skip_line();
  }

  [[nodiscard]] double value(PlyType type) {
    const bool real = type == PlyType::Float32 || type == PlyType::Float64;
    return real ? reader_.real() : static_cast<double>(reader_.integer());
  }
  /// Upper bound on the number of further elements: each value takes at least a digit and a
  /// separator, and the last separator may be missing.
  [[nodiscard]] std::uint64_t max_count(const PlyElement& element) const {
    return (reader_.bytes_left() + 1) / (2 * element.properties.size());
  }
  /// What was not read.
  [[nodiscard]] std::string_view rest() const { return reader_.rest(); }
  [[noreturn]] void fail(const std::string& why) const { reader_.fail(why); }

 private:
  TextReader reader_;
};

/// Reads the values of a binary PLY in order.
class BinaryPlySource {
 public:
  BinaryPlySource(std::filesystem::path path, std::string_view body, PlyFormat format)
      : path_(std::move(path)), left_(body), swapped_(format == PlyFormat::BigEndian) {
    static_assert(std::endian::native == std::endian::little);
  }

  [[nodiscard]] double value(PlyType type) {
    switch (type) {
      case PlyType::Int8:
        return read_value<std::int8_t>();
      case PlyType::Uint8:
        return read_value<std::uint8_t>();
      case PlyType::Int16:
        return read_value<std::int16_t>();
      case PlyType::Uint16:
        return read_value<std::uint16_t>();
      case PlyType::Int32:
        return read_value<std::int32_t>();
      case PlyType::Uint32:
        return read_value<std::uint32_t>();
      case PlyType::Float32:
        return read_value<float>();
      case PlyType::Float64:
        return read_value<double>();
    }
    return 0.0;
  }
  [[nodiscard]] std::uint64_t max_count(const PlyElement& element) const {
    std::size_t bytes = 0;
    for (const PlyProperty& property : element.properties)
      bytes += bytes_of(property.count_type.value_or(property.type));
    return left_.size() / std::max<std::size_t>(bytes, 1);
  }
  /// What was not read.
  [[nodiscard]] std::string_view rest() const { return left_; }
  [[noreturn]] void fail(const std::string& why) const {
    throw Error(ErrorKind::Input, fmt::format("{}: {}", path_.string(), why));
  }

 private:
  template <typename Number>
  Number read_value() {
    std::array<char, sizeof(Number)> bytes{};
    if (left_.size() < bytes.size()) fail("the file is truncated");
    std::memcpy(bytes.data(), left_.data(), bytes.size());
    left_.remove_prefix(bytes.size());
    if (swapped_) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<Number>(bytes);
  }

  std::filesystem::path path_;
  std::string_view left_;
  bool swapped_;
};

/// Reads the length of a list.
template <typename Source>
std::uint64_t read_list_length(Source& source, const PlyProperty& property) {
  constexpr double kMax = 4'294'967'295.0;
  const double length = source.value(property.count_type.value_or(PlyType::Uint8));
  if (!(length >= 0.0 && length <= kMax) || length != std::floor(length)) {
    source.fail(fmt::format("a list '{}' states {} values", property.name, length));
  }
  return static_cast<std::uint64_t>(length);
}

}  // namespace frangia
