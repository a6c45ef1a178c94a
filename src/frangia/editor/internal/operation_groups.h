#pragma once

#include <vector>

#include "frangia/editor/edit_operation.h"

namespace frangia {

/// The groups of operations that edit_operations() joins.
[[nodiscard]] std::vector<EditOperation> selection_operations();
[[nodiscard]] std::vector<EditOperation> repair_operations();
[[nodiscard]] std::vector<EditOperation> modify_operations();

}  // namespace frangia
