#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace frangia {

/// Reads the text of a JSON file that the program wrote itself, such as done.json: what comes back
/// from a disk may have been replaced. A parser of the text needs neither much memory nor a deep
/// stack.
///
/// @errors   Error(Input) as `read_below` for a link, a missing or a larger file, and as
///           `check_json_nesting`
[[nodiscard]] std::string read_json_below(const std::filesystem::path& folder,
                                          const std::filesystem::path& inner,
                                          std::uint64_t max_bytes = 1'000'000);

}  // namespace frangia
