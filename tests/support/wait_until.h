#pragma once

#include <chrono>
#include <thread>

namespace frangia::testing {

/// By when an event has come, even on a busy machine.
inline constexpr double kPatience_s = 60.0;

/// Waits until `condition` holds. Returns whether it does after at most `most_s`.
template <typename Condition>
[[nodiscard]] bool wait_until(const Condition& condition, double most_s = kPatience_s) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(most_s);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return condition();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

/// Whether an action that may wait has returned in time. One that never returns is ended by CTest.
template <typename Action>
[[nodiscard]] bool returns(const Action& action, double most_s = kPatience_s) {
  const auto begin = std::chrono::steady_clock::now();
  action();
  return std::chrono::steady_clock::now() - begin < std::chrono::duration<double>(most_s);
}

}  // namespace frangia::testing
