#pragma once

#include <CLI/CLI.hpp>

#include "terminal.h"

namespace frangia {

/// Adds `calibrate check` to `calibrate`.
void add_calibrate_check_verb(CLI::App& calibrate, Terminal& terminal);

}  // namespace frangia
