#pragma once

#include <CLI/CLI.hpp>

#include "terminal.h"

namespace frangia {

/// Adds `calibrate import` and `calibrate export` to the verb `calibrate`.
void add_calibrate_exchange_verbs(CLI::App& calibrate, Terminal& terminal);

}  // namespace frangia
