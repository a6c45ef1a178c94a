#include "terminal_text.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

namespace frangia {
namespace {

struct Character {
  char32_t code = 0;
  std::size_t bytes = 0;  ///< 0: the text does not begin with valid UTF-8
};

/// Decodes the first character of UTF-8: its shortest form, without surrogates.
Character decode(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  if (first < 0x80U) return {first, 1};
  const std::size_t bytes = first >= 0xF0U ? 4 : first >= 0xE0U ? 3 : 2;
  if (first < 0xC2U || first > 0xF4U || text.size() < bytes) return {};
  char32_t code = first & (0x7FU >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return {};
    code = code << 6U | (byte(i) & 0x3FU);
  }
  constexpr std::array<char32_t, 5> kLeast{0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (code < kLeast.at(bytes) || code > 0x10FFFF || surrogate) return {};
  return {code, bytes};
}

bool is_unsafe(char32_t code) {
  constexpr std::array<std::pair<char32_t, char32_t>, 9> kUnsafe{{
      {0x00, 0x1F},        // control characters
      {0x7F, 0x9F},        // delete and the control characters of ISO 8859
      {0x061C, 0x061C},    // Arabic letter mark
      {0x200B, 0x200F},    // zero width, and the marks of direction
      {0x2028, 0x202E},    // separators of lines, embeddings and overrides of direction
      {0x2066, 0x2069},    // isolates of direction
      {0xFEFF, 0xFEFF},    // byte order mark
      {0xFFF9, 0xFFFB},    // annotations
      {0xE0000, 0xE007F},  // invisible tags
  }};
  return std::any_of(kUnsafe.begin(), kUnsafe.end(), [&](const auto& range) {
    return code >= range.first && code <= range.second;
  });
}

std::string escape_of(char32_t code) {
  const auto number = static_cast<unsigned>(code);
  if (code == '\n') return "\\n";
  if (code == '\r') return "\\r";
  if (code == '\t') return "\\t";
  if (code < 0x80) return fmt::format("\\x{:02x}", number);
  return code < 0x10000 ? fmt::format("\\u{:04x}", number) : fmt::format("\\U{:08x}", number);
}

}  // namespace

std::string terminal_text(std::string_view text) {
  std::string safe;
  safe.reserve(text.size());
  while (!text.empty()) {
    const Character character = decode(text);
    if (character.bytes == 0) {
      safe += fmt::format("\\x{:02x}", static_cast<unsigned char>(text.front()));
    } else if (is_unsafe(character.code)) {
      safe += escape_of(character.code);
    } else {
      safe += text.substr(0, character.bytes);
    }
    text.remove_prefix(std::max<std::size_t>(character.bytes, 1));
  }
  return safe;
}

}  // namespace frangia
