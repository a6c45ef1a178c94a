#pragma once

#include <CLI/CLI.hpp>

#include "terminal.h"

namespace frangia {

/// Adds `calibrate board` to the verb `calibrate`.
void add_calibrate_board_verb(CLI::App& calibrate, Terminal& terminal);

}  // namespace frangia
