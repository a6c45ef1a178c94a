#pragma once

#include <chrono>
#include <string>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

namespace frangia {

/// Says beside a benchmark what was wanted of it and whether it is met.
class PerformanceTarget {
 public:
  /// A figure that should be at most so much.
  void at_most(const std::string& what, double figure, double most, const std::string& unit) {
    if (!text_.empty()) text_ += "; ";
    text_ += fmt::format(
        "{} {:.3g} of {:.3g} {}: {}", what, figure, most, unit, figure <= most ? "met" : "MISSED");
  }
  void label(benchmark::State& state) const { state.SetLabel(text_); }

 private:
  std::string text_;
};

/// Seconds since it was made.
class Stopwatch {
 public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace frangia
