#pragma once

#include <CLI/CLI.hpp>

#include "terminal.h"

namespace frangia {

/// Adds `calibrate display` to the verb `calibrate`.
void add_calibrate_display_verb(CLI::App& calibrate, Terminal& terminal);

}  // namespace frangia
