#pragma once

#include <algorithm>
#include <chrono>

namespace frangia {

/// The moment by which a device must have answered. Every call to a device carries one: nothing
/// hangs because a cable is loose.
class Deadline {
 public:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] static Deadline after(std::chrono::milliseconds time) {
    return Deadline(Clock::now() + time);
  }
  [[nodiscard]] bool passed() const { return Clock::now() >= when_; }
  /// Time left, zero once it has passed.
  [[nodiscard]] Clock::duration left() const {
    return std::max(Clock::duration::zero(), when_ - Clock::now());
  }
  [[nodiscard]] Clock::time_point when() const { return when_; }

 private:
  explicit Deadline(Clock::time_point when) : when_(when) {}
  Clock::time_point when_;
};

}  // namespace frangia
