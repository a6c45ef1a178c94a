#pragma once

#include <nlohmann/json.hpp>

#include "frangia/mesh/mesh_findings.h"

namespace frangia {

/// What `frangia edit --list` and --json say of a mesh.
[[nodiscard]] nlohmann::ordered_json findings_json(const MeshFindings& found);
void print_findings(const MeshFindings& found);

}  // namespace frangia
