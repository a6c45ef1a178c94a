#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "frangia/core/run.h"

namespace frangia {

/// What the person at the program sees: a progress line on a terminal, warnings, notes, and how
/// long each stage took. All of it goes to standard error; standard output is for results.
class Terminal {
 public:
  bool json = false;   ///< results as JSON on standard output, no progress
  bool quiet = false;  ///< warnings and errors only

  /// A Run that is stopped by Ctrl-C or SIGTERM and reports here. The Terminal must outlive it.
  [[nodiscard]] Run run();

  /// Stages in the order they first began, with the seconds spent in each.
  [[nodiscard]] std::vector<std::pair<std::string, double>> stage_seconds();

  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

  /// Ends the progress line.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  void begin_stage(const std::string& name);
  void draw(double done);
  [[nodiscard]] std::string time_left(double done);
  void print_line(const std::string& text);

  std::vector<std::pair<std::string, double>> seconds_;
  std::vector<std::string> warnings_;
  std::vector<std::string> notes_;
  std::string stage_;
  Clock::time_point stage_begin_;
  Clock::time_point last_drawn_;
  Clock::time_point first_drawn_;  ///< of the stage
  double first_done_ = -1.0;       ///< then; below 0 before
  bool line_open_ = false;
};

}  // namespace frangia
