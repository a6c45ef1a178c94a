#include "frangia/core/read_json_below.h"

#include "frangia/core/check_nesting.h"
#include "frangia/core/open_below.h"

namespace frangia {

std::string read_json_below(const std::filesystem::path& folder,
                            const std::filesystem::path& inner,
                            std::uint64_t max_bytes) {
  std::string text = read_below(folder, inner, max_bytes);
  check_json_nesting(text, folder / inner);
  return text;
}

}  // namespace frangia
