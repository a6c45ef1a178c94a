#pragma once

#include <stop_token>

namespace frangia {

/// A token that is stopped by the first SIGINT, SIGTERM or SIGHUP of the process; the second one
/// ends the program at once. The handlers are installed by the first call.
[[nodiscard]] std::stop_token stop_on_signals();

}  // namespace frangia
