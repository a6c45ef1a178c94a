#include "frangia/report/inspection_report.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/durable_file.h"
#include "frangia/inspection/verdict_reasons.h"
#include "frangia/report/internal/report_sheets.h"

namespace frangia {
namespace {

/// The first characters of a text in UTF-8, with "…" for what follows.
std::string shortened(const std::string& text, std::size_t characters) {
  if (report::characters_of(text) <= characters) return text;
  std::size_t end = 0;
  for (std::size_t count = 0; end < text.size(); ++end) {
    const bool begins = (static_cast<unsigned char>(text[end]) & 0xC0U) != 0x80U;
    if (begins && ++count == characters) break;  // one character less, for the dots
  }
  return text.substr(0, end) + "…";
}

}  // namespace

Conformity verdict_of(const InspectionReport& report) {
  return verdict_of(report.surface ? &*report.surface : nullptr, report.characteristics);
}

std::vector<std::string> reasons_of(const InspectionReport& report, const ReportWords& words) {
  std::vector<std::string> reasons;
  for (const VerdictReason& reason :
       verdict_reasons(report.surface ? &*report.surface : nullptr, report.characteristics)) {
    std::string text;
    for (const VerdictClause& clause : reason.clauses)
      text += (text.empty() ? "" : "; ") + words(clause.text);
    reasons.push_back(words(reason.about) + ": " + text);
  }
  return reasons;
}

std::string html_of(const InspectionReport& report) {
  const ReportWords words(report.fields.language);
  const std::string name = words("Inspection report");
  const std::string title = report.part.empty() ? name : name + ": " + report.part;
  // The head is repeated on each sheet, in one line; the first sheet holds the whole name.
  std::string head = report.part.empty() ? name : name + ": " + shortened(report.part, 60);
  if (!report.fields.serial.empty()) head += ", " + shortened(report.fields.serial, 30);
  HtmlPage page(
      title,
      {report.fields.paper, head, report.version + ", " + report.created, words.language(), words},
      false);
  report::add_cover(page, report, words);
  report::add_findings(page, report, words);
  if (report.fields.prints(ReportPage::Annex)) {
    page.new_sheet();
    report::add_annex(page, report, words);
  }
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
