#pragma once

#include <string>

namespace frangia {

/// Describes the first difference between two texts of lines such as "key = value" below headers
/// such as "[camera]": "had "[[view]] 2: angle_deg = 120.0" and now has "[[view]] 2: angle_deg =
/// 90.0"".
[[nodiscard]] std::string first_difference(const std::string& before, const std::string& now);

}  // namespace frangia
