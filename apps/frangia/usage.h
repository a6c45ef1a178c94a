#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace frangia {

/// One sentence that states the fault of the command line and which help to read.
[[nodiscard]] std::string usage_sentence(const CLI::App& program, const CLI::ParseError& error);

}  // namespace frangia
