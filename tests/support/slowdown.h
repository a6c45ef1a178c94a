#pragma once

namespace frangia::testing {

/// How much slower programs may be with sanitizers, as a factor of limits of time.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr double kSlowdown = 6.0;
#else
inline constexpr double kSlowdown = 1.0;
#endif

}  // namespace frangia::testing
