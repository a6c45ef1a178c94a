#pragma once

#include <bit>
#include <filesystem>
#include <string>
#include <string_view>
#include <type_traits>

#include <Eigen/Core>

#include "frangia/core/atomic_file.h"

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

}  // namespace frangia
