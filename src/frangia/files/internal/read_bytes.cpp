#include "frangia/files/internal/read_bytes.h"

#include <cstdint>
#include <limits>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/read_text_file.h"
#include "frangia/files/internal/other_kind.h"

namespace frangia {

std::string read_bytes(const std::filesystem::path& path) {
  std::string bytes = read_text_file(path, std::numeric_limits<std::uint64_t>::max());
  const std::string other = other_kind_of(bytes);
  if (!other.empty()) throw Error(ErrorKind::Input, fmt::format("{}: {}", path.string(), other));
  return bytes;
}

}  // namespace frangia
