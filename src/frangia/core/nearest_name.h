#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frangia {

/// Returns the name that takes the fewest inserted, deleted or replaced letters to become `word`
/// (Levenshtein 1966); of several the first. A name that needs more than a third of the letters of
/// `word` is not near.
///
/// @missing  nullopt: no name is near
[[nodiscard]] std::optional<std::string> nearest_name(std::string_view word,
                                                      const std::vector<std::string>& names);

}  // namespace frangia
