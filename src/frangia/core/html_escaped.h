#pragma once

#include <string>
#include <string_view>

namespace frangia {

/// A text for HTML and SVG: the characters that have a meaning there are replaced by entities.
[[nodiscard]] std::string html_escaped(std::string_view text);

}  // namespace frangia
