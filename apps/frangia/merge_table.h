#pragma once

#include <string>
#include <vector>

#include "frangia/reconstruct/merge_scans.h"

namespace frangia {

/// A length with at least three digits that count: "0.0421", "0.000138".
[[nodiscard]] std::string readable_mm(double value_mm);

/// The merged scans as a table, one line for each.
[[nodiscard]] std::string merge_table(const std::vector<MergedScan>& scans);

/// A line that states how many points of the files are in no view, and why; empty if all are.
[[nodiscard]] std::string dropped_text(const std::vector<MergedScan>& scans);

}  // namespace frangia
