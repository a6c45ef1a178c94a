#include "frangia/files/internal/without_percent.h"

#include <charconv>

namespace frangia {

std::string without_percent(const std::string& uri) {
  std::string plain;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned code = 0;
    const char* const digits = uri.data() + i + 1;
    const bool is_escape = uri[i] == '%' && i + 2 < uri.size() &&
                           std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2;
    plain += is_escape ? static_cast<char>(code) : uri[i];
    if (is_escape) i += 2;
  }
  return plain;
}

}  // namespace frangia
