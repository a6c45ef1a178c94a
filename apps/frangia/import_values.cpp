#include "import_values.h"

#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "frangia/core/error.h"

namespace frangia {

std::vector<PatternValue> values_of(const std::vector<std::string>& texts, const char* option) {
  std::vector<PatternValue> values;
  for (const std::string& text : texts) {
    const std::size_t equals = text.rfind('=');
    const std::string number = equals == std::string::npos ? text : text.substr(equals + 1);
    char* end = nullptr;
    const double value = std::strtod(number.c_str(), &end);
    if (number.empty() || *end != '\0' || !std::isfinite(value) || !(value > 0.0)) {
      throw Error(ErrorKind::Input,
                  fmt::format("`{}` holds \"{}\"; write numbers above 0, such as 64,58,53 or "
                              "fine=64,coarse=8",
                              option,
                              text));
    }
    values.push_back({equals == std::string::npos ? "" : text.substr(0, equals), value});
  }
  return values;
}

ProjectorSize projector_size_of(const std::string& text) {
  ProjectorSize size{};
  char* end = nullptr;
  const long width = std::strtol(text.c_str(), &end, 10);
  const long height = *end == 'x' ? std::strtol(end + 1, &end, 10) : 0;
  if (*end != '\0' || width < 1 || height < 1 || width > 65535 || height > 65535) {
    throw Error(
        ErrorKind::Input,
        fmt::format("`projector` is \"{}\"; write WIDTHxHEIGHT in pixels, such as 1280x800", text));
  }
  size = {static_cast<int>(width), static_cast<int>(height)};
  return size;
}

}  // namespace frangia
