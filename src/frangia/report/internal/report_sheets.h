#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/page/html_page.h"
#include "frangia/report/inspection_report.h"

namespace frangia::report {

using Rows = std::vector<std::vector<std::string>>;  ///< of a table

/// How many characters a text in UTF-8 has; a Greek or Cyrillic letter has two bytes.
[[nodiscard]] inline std::size_t characters_of(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  }));
}

/// A number with that many decimals; empty for NaN.
[[nodiscard]] inline std::string number_text(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "";
}

/// A coordinate with that many decimals, without the sign of a zero.
[[nodiscard]] inline std::string coordinate_text(double value, int decimals) {
  const double step = std::pow(10.0, -decimals);
  return fmt::format("{:.{}f}", std::abs(value) < 0.5 * step ? 0.0 : value, decimals);
}

/// The rows with the words of their first cells in the language of the report.
[[nodiscard]] inline Rows with_words(Rows rows, const ReportWords& words) {
  for (std::vector<std::string>& row : rows)
    row.front() = words(row.front());
  return rows;
}

/// The first sheet: head, verdict, the first picture and the worst rows of results; then all rows,
/// where the first sheet has no room for them.
void add_cover(HtmlPage& page, const InspectionReport& report, const ReportWords& words);
/// The other pictures, the places that are out or undecided, walls, sections and features.
void add_findings(HtmlPage& page, const InspectionReport& report, const ReportWords& words);
/// The decision in detail, the uncertainty, the alignment and the conditions.
void add_annex(HtmlPage& page, const InspectionReport& report, const ReportWords& words);

}  // namespace frangia::report
