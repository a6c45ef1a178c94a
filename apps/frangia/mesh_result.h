#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "frangia/reconstruct/finish_mesh.h"

#include "terminal.h"

namespace frangia {

/// Prints the JSON result of a verb that makes a mesh: `result`, then the keys that all of these
/// verbs share: whether the result is trustworthy and the reason if not, the seconds of each stage,
/// the peak memory, the warnings and the files written.
void print_mesh_result(nlohmann::ordered_json result,
                       const std::string& untrusted_reason,
                       Terminal& terminal,
                       const std::vector<std::filesystem::path>& outputs);

/// The JSON value of the components that were removed.
[[nodiscard]] nlohmann::ordered_json json_of(const RemovedIslands& removed);

/// ", 3 islands of at most 0.5 mm removed"; empty when there were none.
[[nodiscard]] std::string text_of(const RemovedIslands& removed);

/// Prints the end of the result for people: the files written and, under --verbose, the seconds of
/// each stage and the peak memory.
void print_mesh_summary(Terminal& terminal, const std::vector<std::filesystem::path>& outputs);

}  // namespace frangia
