#pragma once

#include <functional>
#include <stop_token>
#include <string>

#include "frangia/core/error.h"

namespace frangia {

/// How a long task is watched and stopped from outside, and where it says what the user should
/// know: the library itself never prints. Cheap to copy; the default does none of it.
/// All functions are called from the thread that started the task.
struct Run {
  std::stop_token stop;
  std::function<void(double)> progress;                ///< called with 0..1
  std::function<void(const std::string&)> on_stage;    ///< a stage begins: "phase", "surface", ...
  std::function<void(const std::string&)> on_warning;  ///< a sentence: goes on, but tell the user
  std::function<void(const std::string&)> on_note;     ///< a sentence: what was chosen and why

  /// Call between units of work. Throws Error(Cancelled) once a stop was asked for.
  void check() const {
    if (stop.stop_requested()) throw Error(ErrorKind::Cancelled, "stopped by the user");
  }
  void report(double done) const {
    check();
    if (progress) progress(done);
  }
  void stage(const std::string& name) const {
    check();
    if (on_stage) on_stage(name);
  }
  void warn(const std::string& sentence) const {
    if (on_warning) on_warning(sentence);
  }
  void note(const std::string& sentence) const {
    if (on_note) on_note(sentence);
  }
};

}  // namespace frangia
