#pragma once

#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

namespace frangia {

/// How a child process ended.
struct ChildResult {
  int exit_code = 0;       ///< 128 + the signal's number for one that a signal ended
  double seconds = 0.0;    ///< on the clock
  double processor_s = 0;  ///< of all its threads
  double memory_mb = 0.0;  ///< most resident memory
};

/// Runs a program with its output in two files and waits for it. When a stop is requested, it gets
/// SIGTERM, and SIGKILL five seconds later. It inherits the open file `lock`, unless that is -1.
///
/// @errors   Error(File) when the program or an output file cannot be opened
[[nodiscard]] ChildResult run_child(const std::vector<std::string>& command,
                                    const std::filesystem::path& output,
                                    const std::filesystem::path& messages,
                                    const std::stop_token& stop,
                                    int lock = -1);

}  // namespace frangia
