#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace frangia {

/// CRC-32 as in zip and PNG: 0xCBF43926 for "123456789".
///
/// source   ISO 3309, the reflected polynomial 0xEDB88320
[[nodiscard]] inline std::uint32_t crc32(std::span<const char> bytes) {
  static constexpr auto kTable = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      std::uint32_t value = i;
      for (int bit = 0; bit < 8; ++bit)
        value = (value >> 1U) ^ ((value & 1U) != 0 ? 0xEDB88320U : 0U);
      table[i] = value;
    }
    return table;
  }();
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char byte : bytes)
    crc = kTable[(crc ^ static_cast<std::uint8_t>(byte)) & 0xFFU] ^ (crc >> 8U);
  return ~crc;
}

}  // namespace frangia
