#pragma once

#include <array>
#include <span>

namespace frangia::report {

/// A text of the report in English, German and Italian; {0}, {1} are values, the same in each.
using ReportRow = std::array<const char*, 3>;

/// The catalogue: what stands before the annex, and then what stands in it or is the form of a
/// name. Of the rows that fit a text the one with the most characters of its own decides.
[[nodiscard]] std::span<const ReportRow> sheet_rows();
[[nodiscard]] std::span<const ReportRow> annex_rows();

}  // namespace frangia::report
