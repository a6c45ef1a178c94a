#include "frangia/report/report_words.h"

#include <algorithm>
#include <vector>

#include "frangia/core/error.h"
#include "frangia/inspection/inspection_plan.h"
#include "frangia/report/internal/fault_rows.h"
#include "frangia/report/internal/report_rows.h"
#include "frangia/report/internal/text_form.h"

namespace frangia {
namespace {

/// The catalogue, the rows with the most characters of their own first: "{0} of {1} in" also fits
/// longer texts that have a row.
const std::vector<report::ReportRow>& all_rows() {
  static const std::vector<report::ReportRow> rows = [] {
    std::vector<report::ReportRow> all;
    for (const auto some : {report::sheet_rows(), report::annex_rows()})
      all.insert(all.end(), some.begin(), some.end());
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
      return report::fixed_of(a[0]) > report::fixed_of(b[0]);
    });
    return all;
  }();
  return rows;
}

}  // namespace

ReportWords::ReportWords(std::string_view language) : language_(language) {
  const auto found = std::find(kReportLanguages.begin(), kReportLanguages.end(), language);
  require(found != kReportLanguages.end(), "a report is in en, de or it");
  column_ = static_cast<std::size_t>(found - kReportLanguages.begin());
}

std::string ReportWords::translated(std::string_view english, bool whole) const {
  if (column_ == 0 || english.empty()) return std::string(english);
  for (const report::ReportRow& row : all_rows()) {
    report::Values values;
    if (!whole && english == row[0]) continue;
    if (report::has_form(row[0], english, report::ValueKind::Clause, values))
      return filled(row.at(column_), values);
  }
  return std::string(english);
}

std::string ReportWords::filled(std::string_view form,
                                std::span<const std::string_view> values) const {
  std::string text;
  while (!form.empty()) {
    const auto place = report::place_at(form);
    if (place) {
      const std::string_view value = values[place->slot()];
      text += place->is_name ? name(value) : (*this)(value);
    } else {
      text += form.front();
    }
    form.remove_prefix(place ? 3 : 1);
  }
  return text;
}

std::string ReportWords::operator()(std::string_view english) const {
  return translated(english, true);
}

std::string ReportWords::name(std::string_view english) const {
  return translated(english, false);
}

std::string ReportWords::warning(std::string_view english) const {
  std::string text = report::worded_fault(english, column_);
  std::erase(text, '`');  // around the names of options
  return text;
}

std::string ReportWords::sentence(std::string_view english) const {
  std::string whole = (*this)(english);
  if (column_ == 0 || whole != english) return whole;
  // A clause may hold a semicolon: the longest beginning that has a row is one.
  std::size_t first = std::string_view::npos;
  for (std::size_t end = english.rfind("; "); end != std::string_view::npos && end > 0;
       end = english.rfind("; ", end - 1)) {
    const std::string_view clause = english.substr(0, end);
    std::string text = (*this)(clause);
    if (text != clause) return text + "; " + sentence(english.substr(end + 2));
    first = end;
  }
  if (first == std::string_view::npos) return whole;
  return std::string(english.substr(0, first)) + "; " + sentence(english.substr(first + 2));
}

}  // namespace frangia
