#include "terminal.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <stop_token>

#include <fmt/format.h>
#include <unistd.h>

namespace frangia {
namespace {

/// Ctrl-C, SIGTERM or a closed terminal ask nicely once; the second one ends the program at once.
std::stop_source& interrupt() {
  static std::stop_source source;
  return source;
}

extern "C" void on_interrupt(int signal) {
  interrupt().request_stop();
  std::signal(signal, SIG_DFL);
}

bool on_a_terminal() {
  return ::isatty(STDERR_FILENO) != 0;
}

}  // namespace

Run Terminal::run() {
  static_cast<void>(interrupt());  // made before a signal can ask for it
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    std::signal(signal, on_interrupt);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error like a full disk
  Run run;
  run.stop = interrupt().get_token();
  run.progress = [this](double done) { draw(done); };
  run.on_stage = [this](const std::string& name) { begin_stage(name); };
  run.on_warning = [this](const std::string& sentence) {
    warnings_.push_back(sentence);
    print_line("warning: " + sentence);
  };
  run.on_note = [this](const std::string& sentence) {
    // What holds for every view alike is said once.
    const bool known = std::find(notes_.begin(), notes_.end(), sentence) != notes_.end();
    if (known || quiet || json) return;
    notes_.push_back(sentence);
    print_line(sentence);
  };
  return run;
}

std::vector<std::pair<std::string, double>> Terminal::stage_seconds() {
  begin_stage({});
  return seconds_;
}

void Terminal::begin_stage(const std::string& name) {
  const auto now = Clock::now();
  if (!stage_.empty()) {
    const auto found = std::find_if(
        seconds_.begin(), seconds_.end(), [&](const auto& entry) { return entry.first == stage_; });
    const double spent = std::chrono::duration<double>(now - stage_begin_).count();
    if (found == seconds_.end()) {
      seconds_.emplace_back(stage_, spent);
    } else {
      found->second += spent;
    }
  }
  stage_ = name;
  stage_begin_ = now;
  first_done_ = -1.0;
}

void Terminal::draw(double done) {
  if (quiet || json || !on_a_terminal()) return;
  const auto now = Clock::now();
  if (now - last_drawn_ < std::chrono::milliseconds(50) && done < 1.0) return;
  last_drawn_ = now;
  constexpr int kWidth = 32;
  const auto full = static_cast<std::size_t>(std::clamp(done, 0.0, 1.0) * kWidth);
  fmt::print(stderr,
             "\r\x1b[K{:<12} [{}{}] {:3.0f} %{}",
             stage_,
             std::string(full, '='),
             std::string(kWidth - full, ' '),
             100.0 * done,
             time_left(done));
  static_cast<void>(std::fflush(stderr));
  line_open_ = true;
}

std::string Terminal::time_left(double done) {
  const auto now = Clock::now();
  if (first_done_ < 0.0 || done < first_done_) {
    first_done_ = done;  // what an earlier session did says nothing about speed
    first_drawn_ = now;
  }
  const double spent_s = std::chrono::duration<double>(now - first_drawn_).count();
  const double advance = done - first_done_;
  constexpr double kEnough_s = 2.0;
  if (spent_s < kEnough_s || advance <= 0.0 || done >= 1.0) return {};
  const auto left_s = static_cast<int>(std::ceil(spent_s * (1.0 - done) / advance));
  if (left_s < 60) return fmt::format(", {} s left", left_s);
  return fmt::format(", {}:{:02} min left", left_s / 60, left_s % 60);
}

void Terminal::print_line(const std::string& text) {
  finish();
  fmt::print(stderr, "{}\n", text);
}

void Terminal::finish() {
  if (line_open_) fmt::print(stderr, "\r\x1b[K");
  line_open_ = false;
}

}  // namespace frangia
