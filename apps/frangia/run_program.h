#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace frangia {

/// What becomes of a program that still runs when its starter is stopped.
enum class WhenStopped {
  LeaveRunning,  ///< it shows something
  End            ///< it works for its starter
};

/// Runs another program without input and output, and waits for it. `words` are its name, looked
/// for in PATH, and its arguments.
///
/// Returns its exit code; -1 when a signal ended it, 0 when it was left running.
/// @missing  none when there is no such program
[[nodiscard]] std::optional<int> run_program(std::vector<std::string> words,
                                             const std::stop_token& stop,
                                             WhenStopped when_stopped);

}  // namespace frangia
