#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace frangia {

/// What is wrong with how the program was called, and whose help tells more: one sentence.
[[nodiscard]] std::string usage_sentence(const CLI::App& program, const CLI::ParseError& error);

}  // namespace frangia
