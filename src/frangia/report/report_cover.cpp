// The first sheet of a report.
#include <algorithm>
#include <cmath>
#include <utility>

#include "frangia/core/text.h"
#include "frangia/inspection/verdict_reasons.h"
#include "frangia/report/internal/report_sheets.h"
#include "frangia/report/result_table.h"

namespace frangia::report {
namespace {

constexpr const char* kDecisionRule =
    "Decision rule: ISO 14253-1:2017, guard band 1.645 u, probability of error 5 %. A value is in "
    "when it lies inside of its limits by the guard band, and out when it lies beyond one by as "
    "much. The bar spans the tolerance; the dot is the value, the line its U95.";

/// Lines that a text takes in a column of so many characters, broken between words.
std::size_t lines_of(const std::string& text, std::size_t characters) {
  std::size_t lines = 1;
  std::size_t used = 0;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = std::min(text.size(), text.find(' ', from));
    const std::size_t word = characters_of(text.substr(from, end - from));
    from = end + 1;
    if (used > 0 && used + 1 + word > characters) {
      ++lines;
      used = 0;
    }
    used += word + (used > 0 ? 1 : 0);
    lines += used > 0 ? (used - 1) / characters : 0;  // a long word is broken anywhere
    used = used > 0 ? (used - 1) % characters + 1 : 0;
  }
  return lines;
}

/// What the head says about the part, in its order: names and texts.
std::vector<std::pair<const char*, const std::string*>> facts_of(const InspectionReport& report) {
  const ReportFields& fields = report.fields;
  std::vector<std::pair<const char*, const std::string*>> facts;
  const auto add = [&](const char* name, const std::string& text) {
    if (!text.empty()) facts.emplace_back(name, &text);
  };
  add("part", report.part);
  add("drawing", fields.drawing);
  add("serial number", fields.serial);
  add("order", fields.order);
  add("customer", fields.customer);
  add("operator", fields.inspector);
  add("mesh", report.mesh);
  add("reference", report.reference);
  return facts;
}

/// Lines of the head beyond one for each of its rows, which hold two facts.
std::size_t more_lines_of_head(const InspectionReport& report) {
  constexpr std::size_t kCharacters = 31;  // of a fact
  const auto facts = facts_of(report);
  std::size_t more = 0;
  for (std::size_t i = 0; i < facts.size(); i += 2) {
    std::size_t lines = lines_of(*facts[i].second, kCharacters);
    if (i + 1 < facts.size()) lines = std::max(lines, lines_of(*facts[i + 1].second, kCharacters));
    more += lines - 1;
  }
  return more;
}

/// The largest deviation with its place, and the extremes of single vertices; empty without a
/// reference, and where nothing was measured.
std::string largest_deviation(const InspectionReport& report, const ReportWords& words) {
  if (!report.surface || !report.deviation) return {};
  const Extreme& worst = worst_extreme(*report.surface);
  if (!std::isfinite(worst.deviation_mm)) return {};
  std::string value = fmt::format("{:+.4f} mm", worst.deviation_mm);
  if (std::isfinite(worst.u95_mm)) value += fmt::format(" ± {:.4f} mm", worst.u95_mm);
  return words.sentence(fmt::format("largest deviation, mean over {:.3g} mm: {} at {}",
                                    report.surface->rule.min_feature_mm,
                                    value,
                                    place_text(worst.at_mm))) +
         "; " +
         words(fmt::format("single vertices, unfiltered: {:+.4f} to {:+.4f} mm",
                           report.deviation->min_mm,
                           report.deviation->max_mm));
}

/// How many rows of results the first sheet has room for, beside the head, the verdict and the
/// picture.
std::size_t rows_on_cover(const InspectionReport& report,
                          const std::vector<MeasuredCharacteristic>& rows,
                          const ReportWords& words) {
  constexpr double kLine_mm = 4.7;
  constexpr double kWarning_mm = 10.0;
  constexpr double kPicture_mm = 92.0;
  constexpr std::size_t kWarnings = 4;  // three, and how many there are besides
  double room_mm = report.fields.paper == "Letter" ? 55.0 : 74.0;  // less the signature
  if (report.pictures.empty()) room_mm += kPicture_mm;
  room_mm -= kWarning_mm * static_cast<double>(std::min(report.warnings.size(), kWarnings));
  for (const std::string& reason : reasons_of(report, words))
    room_mm -= kLine_mm * static_cast<double>(lines_of(reason, 102) - 1);
  room_mm -= kLine_mm * static_cast<double>(more_lines_of_head(report));
  const std::string largest = largest_deviation(report, words);
  if (!largest.empty()) room_mm -= kLine_mm * static_cast<double>(lines_of(largest, 102));
  std::size_t count = 0;
  for (const MeasuredCharacteristic& row : rows) {
    room_mm -= 1.7 + kLine_mm * static_cast<double>(lines_of(words.name(row.name), 21));
    if (!row.reason.empty())
      room_mm -= 1.7 + kLine_mm * static_cast<double>(lines_of(words.sentence(row.reason), 110));
    if (room_mm < 0.0) break;
    ++count;
  }
  return count;
}

const char* word_of(Conformity verdict) {
  if (verdict == Conformity::In) return "In tolerance";
  return verdict == Conformity::Out ? "Out of tolerance" : "Undecided";
}

bool has_verdict(const InspectionReport& report) {
  return report.surface || std::any_of(report.characteristics.begin(),
                                       report.characteristics.end(),
                                       [](const auto& row) { return row.limits.has_value(); });
}

/// A traffic light with the lamp of the verdict lit.
std::string lamps_of(Conformity verdict) {
  const auto lamp = [&](double y, Conformity of, const char* color) {
    return fmt::format(
        "<circle cx=\"20\" cy=\"{}\" r=\"13\" fill=\"{}\"/>", y, verdict == of ? color : "#4b5560");
  };
  return "<svg viewBox=\"0 0 40 104\" width=\"40\" height=\"104\"><rect width=\"40\" "
         "height=\"104\" rx=\"9\" fill=\"#1c2126\"/>" +
         lamp(20, Conformity::Out, "#f04a3c") + lamp(52, Conformity::Undecided, "#ffc233") +
         lamp(84, Conformity::In, "#35c46a") + "</svg>";
}

void add_head(HtmlPage& page, const InspectionReport& report, const ReportWords& words) {
  const ReportFields& fields = report.fields;
  std::string mark;
  if (report.logo) {
    mark = fmt::format("<img alt=\"logo\" src=\"{}\">",
                       data_uri(report.logo->media_type, report.logo->bytes));
  }
  page.html(
      fmt::format("<table class=\"brand\"><tr><td>{}<h1>{}</h1></td><td>{}</td></tr></table>\n",
                  mark,
                  page.word("Inspection report"),
                  html_escaped(fields.date.empty() ? report.created : fields.date)));
  const auto facts = facts_of(report);
  std::string html = "<table class=\"fields\">";
  for (std::size_t i = 0; i < facts.size(); i += 2) {
    html += "<tr>";
    for (std::size_t k = i; k < i + 2; ++k) {
      html += k < facts.size() ? fmt::format("<td class=\"name\">{}</td><td class=\"fact\">{}</td>",
                                             words(facts[k].first),
                                             html_escaped(*facts[k].second))
                               : std::string("<td class=\"name\"></td><td class=\"fact\"></td>");
    }
    html += "</tr>\n";
  }
  page.html(html + "</table>\n");
}

void add_verdict(HtmlPage& page, const InspectionReport& report, const ReportWords& words) {
  if (!has_verdict(report)) return;
  const Conformity verdict = verdict_of(report);
  const bool unknown = (report.surface && !report.surface->uncertainty_known) ||
                       std::any_of(report.characteristics.begin(),
                                   report.characteristics.end(),
                                   [](const auto& row) { return !row.uncertainty_known; });
  const char* const counted =
      unknown ? "but without an uncertainty: the mesh holds no sigma" : "the uncertainty counted";
  std::string text = word_of(verdict);
  if (verdict != Conformity::Undecided) text += fmt::format(", {}", counted);
  const char* kind = verdict == Conformity::Out              ? "bad"
                     : verdict == Conformity::In && !unknown ? "good"
                                                             : "open";
  std::string reasons;
  for (const std::string& reason : reasons_of(report, words))
    reasons += fmt::format("<div>{}</div>", html_escaped(reason));
  const std::string largest = largest_deviation(report, words);
  if (!largest.empty()) reasons += fmt::format("<div>{}</div>", html_escaped(largest));
  page.html(
      fmt::format("<table class=\"signal verdict {}\"><tr><td class=\"lamps\">{}</td><td><div "
                  "class=\"word\">{}</div>{}</td></tr></table>\n",
                  kind,
                  lamps_of(verdict),
                  page.word(text),
                  reasons));
}

/// Where the report is signed.
void add_signature(HtmlPage& page) {
  page.html(
      fmt::format("<table class=\"signature\"><tr><td>{}</td><td class=\"space\"></td><td>{}</td>"
                  "</tr></table>\n",
                  page.word("date"),
                  page.word("signature")));
}

/// Rows of the table of results, the worst first.
std::vector<MeasuredCharacteristic> rows_of_results(const InspectionReport& report) {
  std::vector<MeasuredCharacteristic> rows = report.characteristics;
  if (report.surface) rows.push_back(surface_row(*report.surface));
  return worst_first(std::move(rows));
}

/// The table of results, where the first sheet holds a part of it.
void add_all_results(HtmlPage& page, const InspectionReport& report, const ReportWords& words) {
  const auto rows = rows_of_results(report);
  if (rows.size() <= rows_on_cover(report, rows, words)) return;
  page.heading("Results, the worst first");
  page.html(result_table(rows, rows.size(), words));
}

}  // namespace

void add_cover(HtmlPage& page, const InspectionReport& report, const ReportWords& words) {
  constexpr std::size_t kWarnings = 3;
  add_head(page, report, words);
  add_verdict(page, report, words);
  for (std::size_t i = 0; i < std::min(kWarnings, report.warnings.size()); ++i)
    page.html(fmt::format("<p class=\"verdict open\">{}</p>\n",
                          html_escaped(words.warning(report.warnings[i]))));
  if (report.warnings.size() > kWarnings) {
    const std::size_t more = report.warnings.size() - kWarnings;
    const char* const where =
        report.fields.prints(ReportPage::Annex) ? "the annex" : "the JSON beside this report";
    page.paragraph(fmt::format("{} more warning{}: see {}.", more, more == 1 ? "" : "s", where));
  }
  if (!report.pictures.empty()) page.html(labelled_picture(report.pictures.front(), words));
  const auto rows = rows_of_results(report);
  const std::size_t shown = rows_on_cover(report, rows, words);
  if (shown > 0) page.html(result_table(rows, shown, words));
  const bool all_follow = report.fields.prints(ReportPage::Results);
  if (rows.size() > shown && shown > 0 && all_follow)
    page.paragraph(fmt::format("The {} worst of {} rows; all of them follow.", shown, rows.size()));
  if (rows.size() > shown && !all_follow) {
    page.paragraph(fmt::format(
        "The {} worst of {} rows; the JSON beside this report lists all.", shown, rows.size()));
  }
  if (has_verdict(report)) {
    page.html(fmt::format("<p class=\"small\">{}</p>\n", page.word(kDecisionRule)));
    add_signature(page);
  }
  page.new_sheet();
  if (all_follow) add_all_results(page, report, words);
}

}  // namespace frangia::report
