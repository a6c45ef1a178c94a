#pragma once

#include <CLI/CLI.hpp>

#include "terminal.h"

namespace frangia {

/// Adds `calibrate refine` to the verb `calibrate`.
void add_calibrate_refine_verb(CLI::App& calibrate, Terminal& terminal);

}  // namespace frangia
