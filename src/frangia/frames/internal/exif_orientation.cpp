#include "frangia/frames/internal/exif_orientation.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace frangia {
namespace {

/// An unsigned number of `count` bytes; 0 beyond the end.
std::uint32_t number_at(std::span<const char> bytes, std::size_t at, int count, bool big_endian) {
  if (at > bytes.size() || bytes.size() - at < static_cast<std::size_t>(count)) return 0;
  std::uint32_t value = 0;
  for (int i = 0; i < count; ++i) {
    const int from = big_endian ? i : count - 1 - i;
    const char byte = bytes[at + static_cast<std::size_t>(from)];
    value = value << 8U | static_cast<unsigned char>(byte);
  }
  return value;
}

bool begins_with(std::span<const char> bytes, std::size_t at, std::string_view text) {
  return at <= bytes.size() &&
         std::string_view(bytes.data(), bytes.size()).substr(at).starts_with(text);
}

}  // namespace

int orientation_of_exif(std::span<const char> exif) {
  constexpr std::uint32_t kOrientation = 0x0112;
  constexpr std::size_t kEntryBytes = 12;
  const bool big_endian = begins_with(exif, 0, "MM");
  if (!big_endian && !begins_with(exif, 0, "II")) return 1;
  const std::size_t directory = number_at(exif, 4, 4, big_endian);
  const std::size_t entries = number_at(exif, directory, 2, big_endian);
  for (std::size_t i = 0; i < entries; ++i) {
    const std::size_t entry = directory + 2 + kEntryBytes * i;
    if (entry >= exif.size()) break;
    if (number_at(exif, entry, 2, big_endian) != kOrientation) continue;
    const auto value = static_cast<int>(number_at(exif, entry + 8, 2, big_endian));
    return value >= 1 && value <= 8 ? value : 1;
  }
  return 1;
}

int orientation_of_jpeg(std::span<const char> file) {
  constexpr std::uint32_t kApp1 = 0xffe1;
  constexpr std::uint32_t kStartOfScan = 0xffda;
  constexpr std::string_view kName("Exif\0\0", 6);
  for (std::size_t at = 2; at + 4 <= file.size();) {
    const std::uint32_t marker = number_at(file, at, 2, true);
    const std::size_t length = number_at(file, at + 2, 2, true);
    if (marker < 0xff00 || marker == kStartOfScan || length < 2) break;
    if (marker == kApp1 && begins_with(file, at + 4, kName)) {
      const std::size_t begin = at + 4 + kName.size();
      const std::size_t end = std::min(file.size(), at + 2 + length);
      return begin < end ? orientation_of_exif(file.subspan(begin, end - begin)) : 1;
    }
    at += 2 + length;
  }
  return 1;
}

int orientation_of_png(std::span<const char> file) {
  constexpr std::size_t kSignature = 8;
  constexpr std::size_t kAround = 12;  // length, type and checksum of a chunk
  for (std::size_t at = kSignature; at + kAround <= file.size();) {
    const std::size_t length = number_at(file, at, 4, true);
    if (length > file.size() - at - kAround) break;
    if (begins_with(file, at + 4, "eXIf")) return orientation_of_exif(file.subspan(at + 8, length));
    at += kAround + length;
  }
  return 1;
}

}  // namespace frangia
