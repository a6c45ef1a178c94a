#pragma once

#include <limits>

namespace frangia {

/// What stands where nothing was measured.
inline constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

}  // namespace frangia
