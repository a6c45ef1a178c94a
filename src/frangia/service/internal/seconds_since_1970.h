#pragma once

#include <chrono>
#include <cstdint>

namespace frangia {

/// The present time as files of a project state it.
inline std::int64_t seconds_since_1970() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::seconds>(now).count();
}

}  // namespace frangia
