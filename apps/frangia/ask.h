#pragma once

#include <string>

#include "frangia/core/run.h"

namespace frangia {

/// Whether the user can be asked: standard input and standard error are a terminal.
[[nodiscard]] bool can_ask();

/// Asks a question on standard error and returns whether the answer, a line of standard input, is
/// yes. Ctrl-C ends the question.
///
/// @errors   Error(Cancelled) as Run::check
[[nodiscard]] bool ask(const std::string& question, const Run& run);

}  // namespace frangia
