#pragma once

#include <algorithm>
#include <chrono>
#include <stop_token>
#include <thread>
#include <utility>

#include "frangia/core/error.h"

namespace frangia {

/// Time limit and stop request of a call to a device. Every such call has one, so none blocks
/// forever.
struct Deadline {
  /// Monotonic clock, unaffected by changes of the system time.
  using Clock = std::chrono::steady_clock;

  Clock::time_point time;  ///< end of the time limit
  double timeout_s = 0.0;  ///< the initial time limit, for messages
  std::stop_token stop;    ///< requests that the call stop early

  /// Returns a deadline that passes `seconds` from now.
  [[nodiscard]] static Deadline in(double seconds, std::stop_token stop = {}) {
    const auto span = std::chrono::duration<double>(seconds);
    return {
        Clock::now() + std::chrono::duration_cast<Clock::duration>(span), seconds, std::move(stop)};
  }
  /// The earlier of this deadline and `seconds` from now.
  [[nodiscard]] Deadline at_most(double seconds) const {
    Deadline sooner = in(seconds, stop);
    return sooner.time < time ? sooner : *this;
  }
  /// Whether the time limit has passed.
  [[nodiscard]] bool passed() const { return Clock::now() >= time; }
  /// Throws Error(Cancelled) when a stop was requested.
  void check() const {
    if (stop.stop_requested()) throw Error(ErrorKind::Cancelled, "stopped by the user");
  }
  /// Sleeps in short intervals to react to a stop request. Returns early at the deadline.
  void sleep(double seconds) const {
    const Deadline until = at_most(seconds);
    while (!until.passed()) {
      check();
      const auto piece = Clock::duration(std::chrono::milliseconds(10));
      std::this_thread::sleep_for(std::min(piece, until.time - Clock::now()));
    }
  }
};

}  // namespace frangia
