#pragma once

#include <CLI/CLI.hpp>

#include "terminal.h"

namespace frangia {

/// Each function adds one verb to the program; its source has the verb's name. The verb's callback
/// does the work; main turns an Error thrown there into a sentence and an exit code.
void add_demo_verb(CLI::App& program, Terminal& terminal);
void add_simulate_verb(CLI::App& program, Terminal& terminal);
void add_reconstruct_verb(CLI::App& program, Terminal& terminal);
void add_decode_verb(CLI::App& program, Terminal& terminal);
void add_inspect_verb(CLI::App& program, Terminal& terminal);
void add_accept_verb(CLI::App& program, Terminal& terminal);
void add_algorithms_verb(CLI::App& program, Terminal& terminal);
void add_batch_verb(CLI::App& program, Terminal& terminal);
void add_plan_verb(CLI::App& program, Terminal& terminal);
void add_response_verb(CLI::App& program, Terminal& terminal);
void add_picture_verb(CLI::App& program, Terminal& terminal);
void add_edit_verb(CLI::App& program, Terminal& terminal);
void add_scan_verb(CLI::App& program, Terminal& terminal);
void add_devices_verb(CLI::App& program, Terminal& terminal);
void add_import_verb(CLI::App& program, Terminal& terminal);
void add_calibrate_verb(CLI::App& program, Terminal& terminal);
void add_serve_verb(CLI::App& program, Terminal& terminal);

}  // namespace frangia
