#include "frangia/core/text.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

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

std::string html_escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '&') {
      out += "&amp;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += c;
    }
  }
  return out;
}

namespace {

std::size_t edit_distance(std::string_view word, std::string_view name) {
  std::vector<std::size_t> row(name.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (const char letter : word) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < name.size(); ++j) {
      const std::size_t changed = diagonal + (letter == name[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

}  // namespace

std::optional<std::string> nearest_name(std::string_view word,
                                        const std::vector<std::string>& names) {
  const auto nearest = std::min_element(
      names.begin(), names.end(), [&](const std::string& one, const std::string& other) {
        return edit_distance(word, one) < edit_distance(word, other);
      });
  const bool near = nearest != names.end() && 3 * edit_distance(word, *nearest) <= word.size() + 1;
  return near ? std::optional(*nearest) : std::nullopt;
}

}  // namespace frangia
