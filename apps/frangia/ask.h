#pragma once

#include <optional>
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

/// Prints a prompt on standard error and returns a line of standard input, which need not be a
/// terminal; nothing at its end. Ctrl-C ends it.
///
/// @errors   Error(Cancelled) as Run::check
[[nodiscard]] std::optional<std::string> read_answer(const std::string& prompt, const Run& run);

}  // namespace frangia
