#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "frangia/core/run.h"

#include "progress_line.h"

namespace frangia {

/// What the user sees while a verb works: a progress line, warnings and notes, all on standard
/// error; standard output is for results.
///
/// By default the user sees one line for each view and a summary. `verbose` adds the notes of the
/// stages that work view by view, the seconds of each stage and the peak memory.
class Terminal {
 public:
  bool json = false;         ///< results as JSON on standard output, no progress
  bool quiet = false;        ///< warnings and errors only
  bool verbose = false;      ///< all notes, times and memory
  std::string command_line;  ///< as the user typed it, quoted for a shell
  int exit_code = 0;         ///< of a verb that ends without an error

  /// A Run that reports here and is stopped by Ctrl-C or SIGTERM. The Terminal must outlive it.
  [[nodiscard]] Run run();

  /// Keeps warnings and notes back until `release`, so that the reason why a result is not
  /// trustworthy can be the first line.
  void hold() { holding_ = !verbose; }
  /// Prints what was kept back. Messages that differ by their view and numbers alone are one line.
  void release();

  /// A warning that comes before all that is kept back; where it was given before, it moves.
  void lead(const std::string& sentence);

  /// Prints what was kept back. For a result that must not be trusted, prints the reason first,
  /// leaves out the lines that repeat it, and sets the exit code; `reason` is empty otherwise.
  void assess(const std::string& reason);

  /// Stages in the order in which they first began, with the seconds spent in each.
  [[nodiscard]] std::vector<std::pair<std::string, double>> stage_seconds();

  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

  /// The warnings as the library words them, without flags.
  [[nodiscard]] const std::vector<std::string>& sentences() const { return sentences_; }

  /// Prints "wrote PATH", unless results are JSON or `quiet` is set.
  void print_written(const std::string& path);

  /// Ends the progress line.
  void finish();

 private:
  void begin_stage(const std::string& name);
  void draw(double done);
  void show(const std::string& line);
  void print_line(const std::string& text);

  std::vector<std::pair<std::string, double>> seconds_;
  std::vector<std::string> warnings_;
  std::vector<std::string> sentences_;
  std::vector<std::string> notes_;
  std::vector<std::string> held_;
  std::string stage_;
  std::chrono::steady_clock::time_point stage_begin_;
  std::chrono::steady_clock::time_point last_drawn_;
  ProgressLine progress_;
  bool holding_ = false;
  bool line_open_ = false;
};

}  // namespace frangia
