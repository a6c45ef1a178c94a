#pragma once

#include <CLI/CLI.hpp>

#include "terminal.h"

namespace frangia {

/// Adds `frangia calibrate targets`, which writes stickers to print.
void add_calibrate_targets_verb(CLI::App& calibrate, Terminal& terminal);

}  // namespace frangia
