#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/durable_file.h"
#include "frangia/files/ply.h"
#include "frangia/geometry/mesh.h"

namespace frangia {

/// Buffers small pieces of text or binary data for an AtomicFile.
///
/// @errors   as AtomicFile
class FileWriter {
 public:
  explicit FileWriter(const std::filesystem::path& path);

  void text(std::string_view piece) {
    buffer_.append(piece);
    if (buffer_.size() >= kBlock) flush();
  }
  /// Writes the shortest digits that read back to the same number.
  void number(float value);
  void number(std::size_t value);
  /// Writes a line of a keyword and three numbers.
  void line(std::string_view keyword, const Eigen::Vector3f& vector);

  /// Writes a number in little-endian byte order.
  template <typename Number>
  void binary(Number value) {
    static_assert(std::is_arithmetic_v<Number> && std::endian::native == std::endian::little);
    text({reinterpret_cast<const char*>(&value), sizeof value});  // NOLINT(*-reinterpret-cast)
  }

  void commit();

 private:
  static constexpr std::size_t kBlock = std::size_t{1} << 20U;
  void flush();

  AtomicFile file_;
  std::string buffer_;
};

/// How a format stores the color of a vertex.
enum class ColorLayout {
  Bytes,  ///< red, green and blue, a byte each
  Packed  ///< four bytes: blue, green, red and zero
};

/// Writes the vertices interleaved, as binary PLY and PCD store them: position and normal (floats),
/// sigma and its parts (float), views (2 bytes), mark (1 byte), color, the rest (float). Attributes
/// that the mesh does not have are omitted.
void write_vertices(FileWriter& file,
                    const Mesh& mesh,
                    ColorLayout colors,
                    std::span<const VertexProperty> more = {});

/// The color of screen values from 0 to 1; other values are clipped.
///
/// @missing  NaN gives 0
[[nodiscard]] inline VertexColor color_of(float red, float green, float blue) {
  const auto byte = [](float value) {
    const float clipped = value > 0.0F ? std::min(value, 1.0F) : 0.0F;
    return static_cast<std::uint8_t>(std::lround(255.0F * clipped));
  };
  return {byte(red), byte(green), byte(blue)};
}

/// The colors of numbers whose format allows 1 or 255 for full light: where one is larger than 2,
/// as no rounding of 1 is, it is 255.
[[nodiscard]] inline std::vector<VertexColor> colors_of(
    const std::vector<Eigen::Vector3f>& values) {
  constexpr float kRounded = 2.0F;
  const float full =
      std::any_of(values.begin(),
                  values.end(),
                  [](const Eigen::Vector3f& value) { return value.maxCoeff() > kRounded; })
          ? 255.0F
          : 1.0F;
  std::vector<VertexColor> colors;
  colors.reserve(values.size());
  for (const Eigen::Vector3f& value : values)
    colors.push_back(color_of(value.x() / full, value.y() / full, value.z() / full));
  return colors;
}

}  // namespace frangia
