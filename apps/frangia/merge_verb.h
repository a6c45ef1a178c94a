#pragma once

#include <CLI/CLI.hpp>

#include "terminal.h"

namespace frangia {

/// Adds the verb that merges range scans of other scanners; see verbs.h.
void add_merge_verb(CLI::App& program, Terminal& terminal);

}  // namespace frangia
