#pragma once

#include <limits>

namespace frangia {

/// The value of a missing measurement.
inline constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

}  // namespace frangia
