#pragma once

#include <CLI/CLI.hpp>

#include "terminal.h"

namespace frangia {

/// Adds `scan` to the verb `plan`: how a part is to be scanned so that its tolerances are decided.
void add_plan_scan_verb(CLI::App& plan, Terminal& terminal);

}  // namespace frangia
