#include "progress_line.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace frangia {

void ProgressLine::begin_stage(const std::string& name, Clock::time_point now) {
  name_ = name;
  begin_ = now;
  stages_[name].just_begun = true;
}

void ProgressLine::report(double done, Clock::time_point now) {
  Stage& stage = stages_[name_];
  // A stage that alternates with others view by view continues; a smaller share is a restart.
  if (stage.done < 0.0 || (stage.just_begun && done < stage.done)) {
    stage = {.done = done, .first_done = done, .first_report = now};
  }
  stage.just_begun = false;
  if (done < stage.done) stage.several_passes = true;
  stage.done = std::max(stage.done, done);
}

std::string ProgressLine::time_left(const Stage& stage, Clock::time_point now) {
  constexpr double kMinSpent_s = 3.0;
  constexpr double kMinAdvance = 0.1;  // less does not predict the remaining time
  const double spent_s = std::chrono::duration<double>(now - stage.first_report).count();
  const double advance = stage.done - stage.first_done;
  if (spent_s < kMinSpent_s || advance < kMinAdvance || stage.done >= 1.0) return {};
  const double left_s = std::ceil(spent_s * (1.0 - stage.done) / advance);
  if (left_s < 90.0) return fmt::format(", {:.0f} s left", left_s);
  return fmt::format(", {:.0f} min left", std::ceil(left_s / 60.0));
}

std::string ProgressLine::text(Clock::time_point now) const {
  const auto found = stages_.find(name_);
  if (found == stages_.end() || found->second.done < 0.0 || found->second.several_passes) {
    const double elapsed_s = std::chrono::duration<double>(now - begin_).count();
    return fmt::format("{:<12} {:.0f} s", name_, std::floor(elapsed_s));
  }
  constexpr int kWidth = 32;
  const Stage& stage = found->second;
  const auto full = static_cast<std::size_t>(std::clamp(stage.done, 0.0, 1.0) * kWidth);
  return fmt::format("{:<12} [{}{}] {:3.0f} %{}",
                     name_,
                     std::string(full, '='),
                     std::string(kWidth - full, ' '),
                     100.0 * std::clamp(stage.done, 0.0, 1.0),
                     time_left(stage, now));
}

}  // namespace frangia
