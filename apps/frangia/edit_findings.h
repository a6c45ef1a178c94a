#pragma once

#include <nlohmann/json.hpp>

#include "frangia/mesh/mesh_findings.h"

namespace frangia {

/// The output of `frangia edit --json` and `frangia edit --list`.
[[nodiscard]] nlohmann::ordered_json findings_json(const MeshFindings& found);
void print_findings(const MeshFindings& found);

}  // namespace frangia
