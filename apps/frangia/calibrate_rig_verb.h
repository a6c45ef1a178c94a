#pragma once

#include <CLI/CLI.hpp>

#include "terminal.h"

namespace frangia {

/// Adds `calibrate rig` to the verb `calibrate`.
void add_calibrate_rig_verb(CLI::App& calibrate, Terminal& terminal);

}  // namespace frangia
