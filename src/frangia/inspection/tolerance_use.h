#pragma once

#include <vector>

#include "frangia/inspection/measured_characteristics.h"

namespace frangia {

/// How much of its tolerance a value uses: 0 in the middle, 1 at a limit, more beyond; of an upper
/// limit alone the share of it.
///
/// @missing  NaN without a value or limits
[[nodiscard]] double tolerance_used(const MeasuredCharacteristic& row);

/// Rows with limits, the worst first: those that are out, undecided, in, each by the tolerance that
/// they use; then those without limits.
[[nodiscard]] std::vector<MeasuredCharacteristic> worst_first(
    std::vector<MeasuredCharacteristic> rows);

}  // namespace frangia
