#include "frangia/files/internal/read_bytes.h"

#include <cstdint>
#include <limits>

#include "frangia/core/read_text_file.h"

namespace frangia {

std::string read_bytes(const std::filesystem::path& path) {
  return read_text_file(path, std::numeric_limits<std::uint64_t>::max());
}

}  // namespace frangia
