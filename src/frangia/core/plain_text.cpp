#include "frangia/core/plain_text.h"

#include <algorithm>

namespace frangia {
namespace {

constexpr std::string_view kMarkOfUtf8 = "\xEF\xBB\xBF";
constexpr std::string_view kMarkOfLittleEndian = "\xFF\xFE";
constexpr std::string_view kMarkOfBigEndian = "\xFE\xFF";

/// Whether the first four letters are ASCII with a zero behind (`high` 1) or before them (0), as
/// UTF-16 without a mark has them.
bool has_zeros_at(std::string_view bytes, std::size_t high) {
  constexpr std::size_t kLooked = 4;
  if (bytes.size() < 2 * kLooked) return false;
  for (std::size_t i = 0; i < 2 * kLooked; ++i)
    if ((bytes[i] == '\0') != (i % 2 == high)) return false;
  return true;
}

bool is_big_endian(std::string_view bytes) {
  return bytes.starts_with(kMarkOfBigEndian) || has_zeros_at(bytes, 0);
}

/// Names and comments alone hold other letters.
std::string from_utf16(std::string_view bytes, bool big_endian) {
  std::string text;
  text.reserve(bytes.size() / 2);
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    const char high = bytes[big_endian ? i : i + 1];
    const char low = bytes[big_endian ? i + 1 : i];
    text += high == 0 && low >= 0 ? low : '?';
  }
  return text;
}

/// A CR without an LF becomes one, also beside lines that end otherwise; CR CR LF ends one line.
void end_lines_with_lf(std::string& text) {
  for (std::size_t begin = text.find('\r'); begin != std::string::npos;
       begin = text.find('\r', begin)) {
    const std::size_t end = std::min(text.find_first_not_of('\r', begin), text.size());
    const bool has_lf = end < text.size() && text[end] == '\n';
    if (!has_lf)
      std::fill(text.begin() + static_cast<std::ptrdiff_t>(begin),
                text.begin() + static_cast<std::ptrdiff_t>(end),
                '\n');
    begin = end;
    if (begin == text.size()) return;
  }
}

}  // namespace

bool is_utf16(std::string_view bytes) {
  return bytes.starts_with(kMarkOfLittleEndian) || is_big_endian(bytes) || has_zeros_at(bytes, 1);
}

std::string plain_text(std::string bytes) {
  const std::string_view all(bytes);
  if (all.starts_with(kMarkOfUtf8)) {
    bytes.erase(0, kMarkOfUtf8.size());
  } else if (is_utf16(all)) {
    const bool marked = all.starts_with(kMarkOfLittleEndian) || all.starts_with(kMarkOfBigEndian);
    bytes = from_utf16(all.substr(marked ? 2 : 0), is_big_endian(all));
  }
  constexpr std::string_view kAtTheEnd("\0\x1A", 2);
  const std::size_t last = bytes.find_last_not_of(kAtTheEnd);
  bytes.resize(last == std::string::npos ? 0 : last + 1);
  end_lines_with_lf(bytes);
  return bytes;
}

}  // namespace frangia
