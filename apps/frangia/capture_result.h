#pragma once

#include <filesystem>

#include "frangia/acquisition/capture_options.h"

#include "terminal.h"

namespace frangia {

/// Prints the result of a capture into the folder `output`: one line, and a table of the views that
/// were skipped, or JSON. Skipped views set the exit code of a device fault, 4.
void print_capture(const std::filesystem::path& output,
                   const CaptureReport& report,
                   Terminal& terminal);

}  // namespace frangia
