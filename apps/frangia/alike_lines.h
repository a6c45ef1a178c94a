#pragma once

#include <string>
#include <vector>

namespace frangia {

/// Lines with one for those that say the same of several views or patterns, with other numbers:
/// "warning: views/000, and 7 more alike (--verbose): ...". Two are too few to be put together.
[[nodiscard]] std::vector<std::string> with_alike_put_together(
    const std::vector<std::string>& lines);

}  // namespace frangia
