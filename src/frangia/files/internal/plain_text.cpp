#include "frangia/files/internal/plain_text.h"

#include <algorithm>
#include <string_view>

namespace frangia {
namespace {

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

}  // namespace

std::string plain_text(std::string bytes) {
  const std::string_view all(bytes);
  if (all.starts_with("\xEF\xBB\xBF")) {
    bytes.erase(0, 3);
  } else if (all.starts_with("\xFF\xFE") || all.starts_with("\xFE\xFF")) {
    bytes = from_utf16(all.substr(2), all.starts_with("\xFE"));
  }
  if (bytes.find('\n') == std::string::npos) std::replace(bytes.begin(), bytes.end(), '\r', '\n');
  return bytes;
}

}  // namespace frangia
