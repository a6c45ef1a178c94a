#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace frangia {

/// One sentence that states the fault of the command line and which help to read.
[[nodiscard]] std::string usage_sentence(const CLI::App& program, const CLI::ParseError& error);

/// Refuses options that do not go together. The program then ends with the exit code of a wrong
/// command line, as for a wrong option. `message` names options as with_flags does.
///
/// @errors   CLI::ParseError when the condition does not hold; for the callback of a verb
void require_usage(bool condition, const char* message);

/// The arguments of `frangia help VERB`: those of `frangia VERB --help`, or of `frangia VERB` where
/// there is no such verb. Others stay as they are.
[[nodiscard]] std::vector<std::string> without_help_verb(const CLI::App& program,
                                                         int argc,
                                                         char** argv);

}  // namespace frangia
