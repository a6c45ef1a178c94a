#pragma once

#include <chrono>
#include <map>
#include <string>

namespace frangia {

/// The text of the progress line: the stage, and a bar with the time left where the stage reports
/// one rising share. A stage that reports several passes from 0 to 1 shows its elapsed time
/// instead, because a bar would run backwards.
class ProgressLine {
 public:
  using Clock = std::chrono::steady_clock;

  void begin_stage(const std::string& name, Clock::time_point now);
  void report(double done, Clock::time_point now);
  [[nodiscard]] std::string text(Clock::time_point now) const;

 private:
  struct Stage {
    double done = -1.0;  ///< the largest share reported; below 0: none yet
    double first_done = 0.0;
    Clock::time_point first_report;
    bool several_passes = false;
    bool just_begun = false;
  };
  [[nodiscard]] static std::string time_left(const Stage& stage, Clock::time_point now);

  std::map<std::string, Stage> stages_;
  std::string name_;
  Clock::time_point begin_;
};

}  // namespace frangia
