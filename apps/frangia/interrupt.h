#pragma once

#include <stop_token>

namespace frangia {

/// Starts the thread that handles SIGINT, SIGTERM, SIGHUP and SIGQUIT, and blocks these signals and
/// SIGPIPE in the calling thread and in all threads that it starts. Call it first in `main`.
///
/// The first signal requests a stop. The second one ends the program at once, as the signal does by
/// default; while a `DeviceScope` exists, it leaves the devices 3 s to be made safe. The end of a
/// reader of the output is an error of `write`, as a full disk is; see `reader_has_ended`. So is a
/// file that exceeds the limit of its size (SIGXFSZ).
void handle_signals();

/// A token that is stopped by the first signal.
[[nodiscard]] std::stop_token stop_on_signals();

/// Marks that devices are open, which must be made safe before the program ends. Ctrl-Z, which
/// would leave the light on, is ignored meanwhile.
class DeviceScope {
 public:
  DeviceScope();
  DeviceScope(const DeviceScope&) = delete;
  DeviceScope& operator=(const DeviceScope&) = delete;
  DeviceScope(DeviceScope&&) = delete;
  DeviceScope& operator=(DeviceScope&&) = delete;
  ~DeviceScope();
};

/// Whether the calling thread has written to a pipe without a reader.
[[nodiscard]] bool reader_has_ended();

/// Ends the program as SIGPIPE does by default.
[[noreturn]] void end_by_sigpipe();

}  // namespace frangia
