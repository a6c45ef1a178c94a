#pragma once

#include <filesystem>
#include <vector>

#include "frangia/reconstruct/reconstruct.h"

#include "terminal.h"

namespace frangia {

/// Prints what a reconstruction found: the answer of --json, or for people one line a view, the
/// checks of the rig and a summary. `outputs` and `raw` (the registered points; or empty) are the
/// files that were written.
void print_reconstruction(const Reconstruction& result,
                          const std::vector<std::filesystem::path>& outputs,
                          const std::filesystem::path& raw,
                          Terminal& terminal);

}  // namespace frangia
