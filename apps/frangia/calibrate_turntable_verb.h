#pragma once

#include <CLI/CLI.hpp>

#include "terminal.h"

namespace frangia {

/// Adds the verb `frangia calibrate turntable`.
void add_calibrate_turntable_verb(CLI::App& calibrate, Terminal& terminal);

}  // namespace frangia
