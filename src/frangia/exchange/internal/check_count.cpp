#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/exchange/internal/named_values.h"

namespace frangia {

void check_count(const NamedValues& values, const std::filesystem::path& file) {
  constexpr std::size_t kMaxValues = 10'000;
  if (values.matrices.size() + values.texts.size() <= kMaxValues) return;
  throw Error(
      ErrorKind::Input,
      fmt::format("{}: it holds more than {} values; give a file with the calibration alone",
                  file.string(),
                  kMaxValues));
}

}  // namespace frangia
