#include "terminal.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>

#include <fmt/format.h>
#include <unistd.h>

#include "alike_lines.h"
#include "exit_codes.h"
#include "interrupt.h"
#include "option_names.h"
#include "print_text.h"

namespace frangia {
namespace {

/// Stages that work view by view; their notes are about single patterns.
constexpr std::array<std::string_view, 4> kDetailStages = {"survey", "frames", "phase", "range"};

bool on_a_terminal() {
  return ::isatty(STDERR_FILENO) != 0;
}

}  // namespace

Run Terminal::run() {
  Run run;
  run.stop = stop_on_signals();
  run.progress = [this](double done) { draw(done); };
  run.on_stage = [this](const std::string& name) { begin_stage(name); };
  run.on_warning = [this](const std::string& sentence) {
    sentences_.push_back(sentence);
    warnings_.push_back(with_flags(sentence));
    show("warning: " + warnings_.back());
  };
  run.on_note = [this](const std::string& sentence) {
    const bool detail =
        std::find(kDetailStages.begin(), kDetailStages.end(), stage_) != kDetailStages.end();
    if (quiet || json || (detail && !verbose)) return;
    // A note that holds for every view is printed once.
    if (std::find(notes_.begin(), notes_.end(), sentence) != notes_.end()) return;
    notes_.push_back(sentence);
    show(with_flags(sentence));
  };
  return run;
}

void Terminal::show(const std::string& line) {
  if (holding_) {
    held_.push_back(line);
  } else {
    print_line(line);
  }
}

void Terminal::release() {
  holding_ = false;
  for (const std::string& line : with_alike_put_together(held_))
    print_line(line);
  held_.clear();
}

void Terminal::lead(const std::string& sentence) {
  const std::string text = with_flags(sentence);
  std::erase(warnings_, text);
  std::erase(held_, "warning: " + text);
  warnings_.insert(warnings_.begin(), text);
  if (holding_) {
    held_.insert(held_.begin(), "warning: " + warnings_.front());
  } else {
    print_line("warning: " + warnings_.front());
  }
}

void Terminal::assess(const std::string& reason) {
  if (!reason.empty()) {
    const std::string text = with_flags(reason);
    print_line("the result is not trustworthy: " + text);
    exit_code = NumericFault;
    std::erase_if(held_, [&](const std::string& line) { return line.find(text) != line.npos; });
  }
  release();
}

std::vector<std::pair<std::string, double>> Terminal::stage_seconds() {
  begin_stage({});
  return seconds_;
}

void Terminal::begin_stage(const std::string& name) {
  const auto now = ProgressLine::Clock::now();
  if (!stage_.empty()) {
    const auto found = std::find_if(
        seconds_.begin(), seconds_.end(), [&](const auto& entry) { return entry.first == stage_; });
    const double spent_s = std::chrono::duration<double>(now - stage_begin_).count();
    if (found == seconds_.end()) {
      seconds_.emplace_back(stage_, spent_s);
    } else {
      found->second += spent_s;
    }
  }
  stage_ = name;
  stage_begin_ = now;
  progress_.begin_stage(name, now);
}

void Terminal::draw(double done) {
  const auto now = ProgressLine::Clock::now();
  progress_.report(done, now);
  if (quiet || json || !on_a_terminal()) return;
  constexpr auto kRedraw = std::chrono::milliseconds(50);
  if (now - last_drawn_ < kRedraw) return;
  last_drawn_ = now;
  fmt::print(stderr, "\r\x1b[K{}", terminal_text(progress_.text(now)));
  static_cast<void>(std::fflush(stderr));
  line_open_ = true;
}

void Terminal::print_line(const std::string& text) {
  finish();
  fmt::print(stderr, "{}\n", terminal_text(text));
}

void Terminal::print_written(const std::string& path) {
  finish();
  if (!json && !quiet) print_text("wrote {}\n", path);
}

void Terminal::finish() {
  if (line_open_) fmt::print(stderr, "\r\x1b[K");
  line_open_ = false;
}

}  // namespace frangia
