#pragma once

#include <string>

#include "frangia/dataset/import_frames.h"

namespace frangia {

/// The patterns of an import as a table: their frames in the first view and what they show.
[[nodiscard]] std::string import_table(const ImportPlan& plan);

}  // namespace frangia
