#include "frangia/report/report_words.h"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "frangia/core/error.h"
#include "frangia/inspection/inspection_plan.h"
#include "frangia/report/internal/fault_rows.h"
#include "frangia/report/internal/report_rows.h"

namespace frangia {
namespace {

/// A place for a value in a text.
struct Place {
  std::size_t index = 0;
  bool is_name = false;
};

/// The place that a text begins with, such as {0} or {A}.
std::optional<Place> place_at(std::string_view text) {
  if (text.size() < 3 || text[0] != '{' || text[2] != '}') return std::nullopt;
  const bool is_name = text[1] >= 'A';
  return Place{static_cast<std::size_t>(text[1] - (is_name ? 'A' : '0')), is_name};
}

using Values = std::array<std::string_view, 20>;  // names behind the others

std::size_t slot_of(const Place& place) {
  return place.index + (place.is_name ? 10U : 0U);
}

/// Whether a text can be a value: it is no sentence of several clauses.
bool is_value(std::string_view text) {
  return !text.empty() && text.find("; ") == std::string_view::npos;
}

/// Whether the text has the form of the row; then its values. A value is as short as possible.
bool matches(std::string_view form, std::string_view text, Values& values) {
  while (!form.empty()) {
    const auto place = place_at(form);
    if (!place) {
      if (text.empty() || text.front() != form.front()) return false;
      form.remove_prefix(1);
      text.remove_prefix(1);
      continue;
    }
    form.remove_prefix(3);
    if (form.empty()) {
      values.at(slot_of(*place)) = text;
      return is_value(text);
    }
    const std::string_view literal = form.substr(0, form.find('{'));
    for (std::size_t at = text.find(literal, 1); at != std::string_view::npos;
         at = text.find(literal, at + 1)) {
      if (!is_value(text.substr(0, at))) return false;
      if (!matches(form, text.substr(at), values)) continue;
      values.at(slot_of(*place)) = text.substr(0, at);
      return true;
    }
    return false;
  }
  return text.empty();
}

/// How many characters of a form are no place for a value.
std::size_t fixed_of(std::string_view form) {
  std::size_t fixed = 0;
  while (!form.empty()) {
    const bool place = place_at(form).has_value();
    if (!place) ++fixed;
    form.remove_prefix(place ? 3 : 1);
  }
  return fixed;
}

/// The catalogue, the rows with the most characters of their own first: "{0} of {1} in" also fits
/// longer texts that have a row.
const std::vector<report::ReportRow>& all_rows() {
  static const std::vector<report::ReportRow> rows = [] {
    std::vector<report::ReportRow> all;
    for (const auto some : {report::sheet_rows(), report::annex_rows()})
      all.insert(all.end(), some.begin(), some.end());
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
      return fixed_of(a[0]) > fixed_of(b[0]);
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
    Values values;
    if (!whole && english == row[0]) continue;
    if (matches(row[0], english, values)) return filled(row.at(column_), values);
  }
  return std::string(english);
}

std::string ReportWords::filled(std::string_view form,
                                std::span<const std::string_view> values) const {
  std::string text;
  while (!form.empty()) {
    const auto place = place_at(form);
    if (place) {
      const std::string_view value = values[slot_of(*place)];
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
