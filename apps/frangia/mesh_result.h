#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "terminal.h"

namespace frangia {

/// Prints the result of a verb that made a mesh, as JSON: what the verb has to say, and what all of
/// them end with, the seconds of each stage, the memory, the warnings and the files.
void print_mesh_result(nlohmann::ordered_json result,
                       Terminal& terminal,
                       const std::vector<std::filesystem::path>& outputs);

/// The same end for people: the seconds of each stage, the memory and the files.
void print_mesh_summary(Terminal& terminal, const std::vector<std::filesystem::path>& outputs);

}  // namespace frangia
