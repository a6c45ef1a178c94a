#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "batch/batch_task.h"

namespace frangia {

/// The rows as a table for the terminal.
[[nodiscard]] std::string table_of(const std::vector<BatchRow>& rows);

/// Writes OUT/table.csv and OUT/table.json, each by a rename.
///
/// @errors   Error(File)
void write_table(const std::vector<BatchRow>& rows, const std::filesystem::path& out);

}  // namespace frangia
