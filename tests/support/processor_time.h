#pragma once

#include <ctime>

namespace frangia::testing {

/// Processor time of this process that some work takes, of all threads, in seconds: other programs
/// on the machine do not add to it.
template <typename Work>
[[nodiscard]] double processor_seconds_of(const Work& work) {
  const auto now_s = [] {
    std::timespec time{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  const double begin_s = now_s();
  work();
  return now_s() - begin_s;
}

}  // namespace frangia::testing
