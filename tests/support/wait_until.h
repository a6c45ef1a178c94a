#pragma once

#include <chrono>
#include <thread>

namespace frangia::testing {

/// Waits until `condition` holds. Returns the seconds that it took, or a negative number when it
/// does not hold after `most_s`.
template <typename Condition>
double wait_until(const Condition& condition, double most_s) {
  const auto begin = std::chrono::steady_clock::now();
  for (;;) {
    const bool holds = condition();
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (holds) return seconds;
    if (seconds > most_s) return -1.0;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace frangia::testing
