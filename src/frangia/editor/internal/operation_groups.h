#pragma once

#include <vector>

#include "frangia/editor/edit_operation.h"

namespace frangia {

/// The operations of each kind, as edit_operations() joins them.
[[nodiscard]] std::vector<EditOperation> selection_operations();
[[nodiscard]] std::vector<EditOperation> repair_operations();
[[nodiscard]] std::vector<EditOperation> modify_operations();

}  // namespace frangia
