#pragma once

#include <vector>

#include "frangia/mesh/edit_operation.h"

namespace frangia {

/// The operations of each kind, as edit_operations() joins them.
[[nodiscard]] std::vector<EditOperation> selecting_edits();
[[nodiscard]] std::vector<EditOperation> repairing_edits();
[[nodiscard]] std::vector<EditOperation> changing_edits();

}  // namespace frangia
