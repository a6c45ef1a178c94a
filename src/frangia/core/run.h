#pragma once

#include <functional>
#include <memory>
#include <set>
#include <stop_token>
#include <string>

#include "frangia/core/error.h"

namespace frangia {

/// Progress, cancellation and messages of a long task. The library itself never prints. Copies are
/// cheap; a default-constructed Run ignores everything. All functions are called from the thread
/// that started the task.
struct Run {
  std::stop_token stop;                                ///< requests that the task stop
  std::function<void(double)> progress;                ///< called with 0..1
  std::function<void(const std::string&)> on_stage;    ///< a stage begins: "phase", "surface", ...
  std::function<void(const std::string&)> on_warning;  ///< a warning sentence
  std::function<void(const std::string&)> on_note;     ///< a sentence of information

  /// Throws Error(Cancelled) once a stop is requested. Call it between units of work.
  void check() const {
    if (stop.stop_requested()) throw Error(ErrorKind::Cancelled, "stopped by the user");
  }
  /// Reports the finished share of the task, 0 to 1. Throws Error(Cancelled) once a stop is
  /// requested.
  void report(double done) const {
    check();
    if (progress) progress(done);
  }
  /// Announces the stage that begins. Throws Error(Cancelled) once a stop is requested.
  void stage(const std::string& name) const {
    check();
    if (on_stage) on_stage(name);
  }
  /// Passes a warning to `on_warning`, if it is set.
  void warn(const std::string& sentence) const {
    if (on_warning) on_warning(sentence);
  }
  /// Passes a sentence of information to `on_note`, if it is set.
  void note(const std::string& sentence) const {
    if (on_note) on_note(sentence);
  }
};

/// Returns a run that passes each warning on once, for tasks that do a stage again.
[[nodiscard]] inline Run without_repeated_warnings(const Run& run) {
  Run once = run;
  if (!run.on_warning) return once;
  once.on_warning = [passed = std::make_shared<std::set<std::string>>(),
                     pass = run.on_warning](const std::string& sentence) {
    if (passed->insert(sentence).second) pass(sentence);
  };
  return once;
}

}  // namespace frangia
