#pragma once

#include <chrono>
#include <string>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

namespace frangia {

/// Labels a benchmark with its performance target and whether the target is met.
class PerformanceTarget {
 public:
  /// A figure that should not exceed `most`.
  void at_most(const std::string& what, double figure, double most, const std::string& unit) {
    if (!text_.empty()) text_ += "; ";
    text_ += fmt::format(
        "{} {:.3g} of {:.3g} {}: {}", what, figure, most, unit, figure <= most ? "met" : "MISSED");
  }
  void label(benchmark::State& state) const { state.SetLabel(text_); }

 private:
  std::string text_;
};

/// Seconds since construction.
class Stopwatch {
 public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace frangia
