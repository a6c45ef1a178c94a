#include "frangia/report/inspection_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/write_text_file.h"
#include "frangia/inspection/inspect_part.h"
#include "frangia/report/internal/report_sheets.h"
#include "frangia/report/result_table.h"

namespace frangia {

Conformity verdict_of(const InspectionReport& report) {
  return verdict_of(report.surface ? &*report.surface : nullptr, report.characteristics);
}

std::vector<std::string> reasons_of(const InspectionReport& report) {
  std::vector<std::string> reasons;
  std::array<std::size_t, 3> count{};
  std::size_t limited = 0;
  for (const MeasuredCharacteristic& row : report.characteristics) {
    if (!row.limits) continue;
    ++limited;
    ++count.at(static_cast<std::size_t>(row.conformity));
  }
  const auto of = [&](Conformity conformity) {
    return count.at(static_cast<std::size_t>(conformity));
  };
  if (limited > 0) {
    std::string text = fmt::format("characteristics: {} of {} in", of(Conformity::In), limited);
    if (of(Conformity::Out) > 0) text += fmt::format(", {} out", of(Conformity::Out));
    if (of(Conformity::Undecided) > 0)
      text += fmt::format(", {} undecided", of(Conformity::Undecided));
    const auto rows = worst_first(report.characteristics);
    const MeasuredCharacteristic& worst = rows.front();
    if (worst.conformity != Conformity::In) {
      text += std::isfinite(worst.value) ? fmt::format("; the worst is {}: {:.4f} {}, U95 {:.4f}",
                                                       worst.name,
                                                       worst.value,
                                                       worst.unit,
                                                       worst.u95)
                                         : fmt::format("; {} was not found", worst.name);
    }
    reasons.push_back(std::move(text));
  }
  if (!report.surface) return reasons;
  const std::string surface = "surface: " + sentence_of(*report.surface);
  // What decided stands first.
  const bool first = report.surface->conformity == verdict_of(report) &&
                     overall(report.characteristics) != Conformity::Out;
  reasons.insert(first ? reasons.begin() : reasons.end(), surface);
  return reasons;
}

std::string html_of(const InspectionReport& report) {
  const std::string title =
      report.part.empty() ? "Inspection report" : "Inspection report: " + report.part;
  std::string head = title;
  if (!report.fields.serial.empty()) head += ", " + report.fields.serial;
  HtmlPage page(title, {report.fields.paper, head, report.version + ", " + report.created}, false);
  report::add_cover(page, report);
  report::add_findings(page, report);
  page.new_sheet();
  report::add_annex(page, report);
  return page.text();
}

std::string csv_of(const std::vector<MeasuredCharacteristic>& rows) {
  std::string csv = "name,unit,nominal,lower,upper,value,u95,conformity\n";
  const auto exact = [](double value) {
    return std::isfinite(value) ? fmt::format("{:.6g}", value) : std::string();
  };
  for (const MeasuredCharacteristic& row : rows) {
    std::string name;
    for (const char c : row.name)
      name += c == '"' ? "\"\"" : std::string(1, c);
    csv += fmt::format("\"{}\",{},{},{},{},{},{},{}\n",
                       name,
                       row.unit,
                       row.nominal ? exact(*row.nominal) : "",
                       row.limits ? exact(row.limits->lower) : "",
                       row.limits ? exact(row.limits->upper) : "",
                       exact(row.value),
                       exact(row.u95),
                       row.limits ? name_of(row.conformity) : "");
  }
  return csv;
}

}  // namespace frangia
