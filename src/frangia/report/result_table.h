#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "frangia/inspect/surface_verdict.h"
#include "frangia/inspection/measured_characteristics.h"
#include "frangia/report/report_words.h"

namespace frangia {

/// Of the extremes of a surface the one that uses more of the tolerance; its deviation is NaN where
/// nothing was measured.
[[nodiscard]] const Extreme& worst_extreme(const SurfaceVerdict& verdict);

/// The surface as a row of the table of results: of its patches the one that uses most of the
/// tolerance.
[[nodiscard]] MeasuredCharacteristic surface_row(const SurfaceVerdict& verdict);

/// A drawing of the tolerance, the value and its U95. A value beyond the drawing is an arrow.
[[nodiscard]] std::string tolerance_bar(const MeasuredCharacteristic& row);

/// The first `count` rows as a table: nominal, tolerance, measured, deviation, U95, tolerance used
/// and verdict.
[[nodiscard]] std::string result_table(const std::vector<MeasuredCharacteristic>& rows,
                                       std::size_t count,
                                       const ReportWords& words = ReportWords());

}  // namespace frangia
