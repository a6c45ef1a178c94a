#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "frangia/inspect/surface_verdict.h"
#include "frangia/inspection/measured_characteristics.h"

namespace frangia {

/// The surface as a row of the table of results: of its patches the one that uses most of the
/// tolerance.
[[nodiscard]] MeasuredCharacteristic surface_row(const SurfaceVerdict& verdict);

/// How much of its tolerance a value uses: 0 in the middle, 1 at a limit, more beyond; of an upper
/// limit alone the share of it.
///
/// @missing  NaN without a value or limits
[[nodiscard]] double tolerance_used(const MeasuredCharacteristic& row);

/// Rows with limits, the worst first: those that are out, undecided, in, each by the tolerance that
/// they use; then those without limits.
[[nodiscard]] std::vector<MeasuredCharacteristic> worst_first(
    std::vector<MeasuredCharacteristic> rows);

/// A drawing of the tolerance, the value and its U95. A value beyond the drawing is an arrow.
[[nodiscard]] std::string tolerance_bar(const MeasuredCharacteristic& row);

/// The first `count` rows as a table: nominal, tolerance, measured, deviation, U95, tolerance used
/// and verdict.
[[nodiscard]] std::string result_table(const std::vector<MeasuredCharacteristic>& rows,
                                       std::size_t count);

}  // namespace frangia
