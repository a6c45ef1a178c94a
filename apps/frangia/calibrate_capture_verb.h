#pragma once

#include <CLI/CLI.hpp>

#include "terminal.h"

namespace frangia {

/// Adds `calibrate capture` to the verb `calibrate`.
void add_calibrate_capture_verb(CLI::App& calibrate, Terminal& terminal);

}  // namespace frangia
