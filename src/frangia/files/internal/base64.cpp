#include "frangia/files/internal/base64.h"

#include <array>
#include <cstdint>

namespace frangia {
namespace {

constexpr std::string_view kLetters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::array<int, 256> values_of_letters() {
  std::array<int, 256> values{};
  values.fill(-1);
  for (std::size_t i = 0; i < kLetters.size(); ++i)
    values.at(static_cast<unsigned char>(kLetters[i])) = static_cast<int>(i);
  return values;
}

}  // namespace

std::string encode_base64(std::string_view bytes) {
  std::string letters;
  letters.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::string_view three = bytes.substr(i, 3);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8U | (k < three.size() ? static_cast<unsigned char>(three[k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) {
      letters +=
          k <= three.size() ? kLetters[bits >> (18U - 6U * static_cast<unsigned>(k)) & 63U] : '=';
    }
  }
  return letters;
}

std::optional<std::string> decode_base64(std::string_view letters) {
  static const std::array<int, 256> kValues = values_of_letters();
  while (letters.ends_with('='))
    letters.remove_suffix(1);
  std::string bytes;
  bytes.reserve(letters.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  unsigned count = 0;
  for (const char letter : letters) {
    const int value = kValues.at(static_cast<unsigned char>(letter));
    if (value < 0) return std::nullopt;
    bits = bits << 6U | static_cast<std::uint32_t>(value);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xFFU);
  }
  return bytes;
}

}  // namespace frangia
