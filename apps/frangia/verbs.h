#pragma once

#include <CLI/CLI.hpp>

#include "terminal.h"

namespace frangia {

/// Each adds one verb to the program, in the file of its name. The work is done in the verb's
/// callback; an Error thrown there becomes a sentence and an exit code in main.
void add_demo_verb(CLI::App& program, Terminal& terminal);
void add_simulate_verb(CLI::App& program, Terminal& terminal);
void add_reconstruct_verb(CLI::App& program, Terminal& terminal);
void add_decode_verb(CLI::App& program, Terminal& terminal);
void add_inspect_verb(CLI::App& program, Terminal& terminal);
void add_algorithms_verb(CLI::App& program, Terminal& terminal);
void add_plan_verb(CLI::App& program, Terminal& terminal);
void add_response_verb(CLI::App& program, Terminal& terminal);
void add_picture_verb(CLI::App& program, Terminal& terminal);
void add_edit_verb(CLI::App& program, Terminal& terminal);
void add_scan_verb(CLI::App& program, Terminal& terminal);
void add_devices_verb(CLI::App& program, Terminal& terminal);
void add_calibrate_verb(CLI::App& program, Terminal& terminal);

}  // namespace frangia
