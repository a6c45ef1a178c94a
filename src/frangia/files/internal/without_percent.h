#pragma once

#include <string>

namespace frangia {

/// A uri, or the name of a part of a package, with its escapes, such as %20 for a blank, replaced.
[[nodiscard]] std::string without_percent(const std::string& uri);

}  // namespace frangia
