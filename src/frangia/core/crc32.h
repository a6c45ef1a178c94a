#pragma once

#include <cstdint>
#include <span>

namespace frangia {

/// Returns the CRC-32 of zip and PNG: 0xCBF43926 for "123456789".
///
/// @source   ISO 3309, the reflected polynomial 0xEDB88320, by zlib
[[nodiscard]] std::uint32_t crc32(std::span<const char> bytes);

}  // namespace frangia
