#include "frangia/core/crc32.h"

#include <zlib.h>

namespace frangia {

std::uint32_t crc32(std::span<const char> bytes) {
  const auto* data = reinterpret_cast<const Bytef*>(bytes.data());  // NOLINT: bytes are bytes
  return static_cast<std::uint32_t>(::crc32_z(0, data, bytes.size()));
}

}  // namespace frangia
