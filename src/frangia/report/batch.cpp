#include "frangia/report/batch.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/page/html_page.h"

namespace frangia {
namespace {

void add_statistics_of(BatchCharacteristic& one) {
  std::vector<double> known;
  std::copy_if(one.values.begin(), one.values.end(), std::back_inserter(known), [](double value) {
    return std::isfinite(value);
  });
  if (known.empty()) return;
  const auto count = static_cast<double>(known.size());
  one.mean = 0.0;
  for (const double value : known)
    one.mean += value / count;
  if (known.size() < 2) return;
  double squares = 0.0;
  for (const double value : known)
    squares += (value - one.mean) * (value - one.mean);
  one.deviation = std::sqrt(squares / (count - 1.0));
  if (!one.limits || !(one.deviation > 0.0)) return;
  const bool has_lower = std::isfinite(one.limits->lower);
  const bool has_upper = std::isfinite(one.limits->upper);
  const double upper = has_upper ? one.limits->upper - one.mean : kMissing;
  const double lower = has_lower ? one.mean - one.limits->lower : kMissing;
  if (has_lower && has_upper)
    one.cp = (one.limits->upper - one.limits->lower) / (6.0 * one.deviation);
  one.cpk = std::fmin(upper, lower) / (3.0 * one.deviation);
  constexpr double k95 = 1.645;  // one-sided
  one.cpk_lower_95 =
      one.cpk - k95 * std::sqrt(1.0 / (9.0 * count) + one.cpk * one.cpk / (2.0 * (count - 1.0)));
}

std::string value_text(double value, int decimals = 4) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "";
}

/// The values over the parts with their intervals, and the limits.
std::string trend_svg(const BatchCharacteristic& one) {
  constexpr double kWide = 540.0;
  constexpr double kHigh = 190.0;
  constexpr double kLeft = 70.0;
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  const auto extend = [&](double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  };
  for (std::size_t i = 0; i < one.values.size(); ++i) {
    extend(one.values[i] - one.u95[i]);
    extend(one.values[i] + one.u95[i]);
  }
  if (one.limits) {
    extend(one.limits->lower);
    extend(one.limits->upper);
  }
  if (!(high > low)) high = low + 1e-6;
  const double margin = 0.06 * (high - low);
  const auto y = [&](double value) {
    return 8.0 + (high + margin - value) / (high - low + 2.0 * margin) * (kHigh - 34.0);
  };
  const auto x = [&](std::size_t i) {
    const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(one.values.size());
    return kLeft + share * (kWide - kLeft - 8.0);
  };
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"540\" viewBox=\"0 0 {} {}\" "
      "style=\"background:#fff;border:1px solid #ccd\" font-family=\"sans-serif\" "
      "font-size=\"12\">\n",
      kWide,
      kHigh);
  // The mean stands at the right end, where it cannot hide the number of a limit.
  const auto level = [&](double value, const char* color, bool right) {
    if (!std::isfinite(value)) return;
    svg += fmt::format(
        "<path d=\"M{0} {1:.1f}H{2}\" stroke=\"{3}\"/><text x=\"{4}\" y=\"{5:.1f}\" "
        "fill=\"{3}\" text-anchor=\"end\">{6:.4f}</text>\n",
        kLeft,
        y(value),
        kWide - 8.0,
        color,
        right ? kWide - 10.0 : kLeft - 5.0,
        y(value) + (right ? -4.0 : 4.0),
        value);
  };
  if (one.limits) level(one.limits->lower, "#b01818", false);
  if (one.limits) level(one.limits->upper, "#b01818", false);
  level(one.mean, "#666", true);
  std::string line;
  for (std::size_t i = 0; i < one.values.size(); ++i) {
    if (!std::isfinite(one.values[i])) continue;
    line += fmt::format("{}{:.1f} {:.1f}", line.empty() ? "M" : "L", x(i), y(one.values[i]));
    const double u = std::isfinite(one.u95[i]) ? one.u95[i] : 0.0;
    svg += fmt::format(
        "<path d=\"M{0:.1f} {1:.1f}V{2:.1f}\" stroke=\"#1f5fbf\"/><circle cx=\"{0:.1f}\" "
        "cy=\"{3:.1f}\" r=\"3\" fill=\"#1f5fbf\"/>\n",
        x(i),
        y(one.values[i] - u),
        y(one.values[i] + u),
        y(one.values[i]));
  }
  return svg + fmt::format(
                   "<path d=\"{}\" fill=\"none\" stroke=\"#1f5fbf\" stroke-opacity=\".5\"/>\n"
                   "<text x=\"{}\" y=\"{}\">{}, by part; bars: U95</text>\n</svg>\n",
                   line,
                   kLeft,
                   kHigh - 6.0,
                   one.unit);
}

using TextOf = std::string (*)(const BatchCharacteristic&);

/// The lines below the parts.
const std::vector<std::pair<const char*, TextOf>>& statistics_lines() {
  static const std::vector<std::pair<const char*, TextOf>> lines{
      {"mean", [](const BatchCharacteristic& one) { return value_text(one.mean); }},
      {"standard deviation",
       [](const BatchCharacteristic& one) { return value_text(one.deviation, 5); }},
      {"Cp", [](const BatchCharacteristic& one) { return value_text(one.cp, 2); }},
      {"Cpk", [](const BatchCharacteristic& one) { return value_text(one.cpk, 2); }},
      {"Cpk exceeds, 95 %", [](const BatchCharacteristic& one) {
         if (!(one.cpk_lower_95 < 0.0)) return value_text(one.cpk_lower_95, 2);
         // The mean is within the limits, but so few parts prove nothing about the process.
         return std::string(one.cpk > 0.0 ? "too few parts" : "nothing above 0");
       }}};
  return lines;
}

/// The surface decides, too: a part with good diameters and a dent is out.
std::string_view decision_of(const BatchPart& part) {
  return part.inspected ? name_of(part.verdict) : "not inspected";
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text)
    out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}

/// A table of some characteristics, with the parts and their decisions.
void add_results(HtmlPage& page,
                 const std::vector<BatchPart>& parts,
                 std::span<const BatchCharacteristic> characteristics) {
  std::vector<std::string> columns{"part"};
  for (const BatchCharacteristic& one : characteristics)
    columns.push_back(one.name + ", " + one.unit);
  columns.emplace_back("decision");
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    rows.push_back({parts[i].name});
    for (const BatchCharacteristic& one : characteristics) {
      std::string text = std::isfinite(one.values[i]) ? fmt::format("{:.4f}", one.values[i])
                         : parts[i].inspected         ? "not found"
                                                      : "";
      if (std::isfinite(one.u95[i])) text += fmt::format(" ± {:.4f}", one.u95[i]);
      rows.back().push_back(std::move(text));
    }
    rows.back().emplace_back(decision_of(parts[i]));
  }
  for (const auto& [name, text_of] : statistics_lines()) {
    rows.push_back({name});
    for (const BatchCharacteristic& one : characteristics)
      rows.back().push_back(text_of(one));
    rows.back().emplace_back("");
  }
  page.table(columns, rows);
}

}  // namespace

std::vector<BatchCharacteristic> batch_characteristics(const std::vector<BatchPart>& parts) {
  std::vector<BatchCharacteristic> all;
  const auto first =
      std::find_if(parts.begin(), parts.end(), [](const auto& part) { return part.inspected; });
  if (first == parts.end()) return all;
  for (const MeasuredCharacteristic& row : first->rows) {
    BatchCharacteristic one;
    one.name = row.name;
    one.unit = row.unit;
    one.limits = row.limits;
    all.push_back(std::move(one));
  }
  for (const BatchPart& part : parts) {
    if (!part.inspected) {
      for (BatchCharacteristic& one : all) {
        one.values.push_back(kMissing);
        one.u95.push_back(kMissing);
      }
      continue;
    }
    require(all.size() == part.rows.size(),
            "the parts of a batch must have the same characteristics; inspect them by one plan");
    for (std::size_t i = 0; i < all.size(); ++i) {
      require(all[i].name == part.rows[i].name,
              "the parts of a batch must have the same characteristics; inspect them by one plan");
      all[i].values.push_back(part.rows[i].value);
      all[i].u95.push_back(part.rows[i].u95);
    }
  }
  for (BatchCharacteristic& one : all)
    add_statistics_of(one);
  return all;
}

std::string batch_csv(const std::vector<BatchPart>& parts,
                      const std::vector<BatchCharacteristic>& characteristics) {
  std::string csv = "part";
  for (const BatchCharacteristic& one : characteristics)
    csv += fmt::format(",{},{}", quoted(one.name + " " + one.unit), quoted(one.name + " U95"));
  csv += ",decision,reason\n";
  for (std::size_t i = 0; i < parts.size(); ++i) {
    csv += quoted(parts[i].name);
    for (const BatchCharacteristic& one : characteristics)
      csv += fmt::format(",{},{}", value_text(one.values[i], 6), value_text(one.u95[i], 6));
    csv += fmt::format(",{},{}\n", decision_of(parts[i]), quoted(parts[i].reason));
  }
  for (const auto& [name, text_of] : statistics_lines()) {
    csv += name;
    for (const BatchCharacteristic& one : characteristics)
      csv += fmt::format(",{},", text_of(one));
    csv += ",,\n";
  }
  return csv;
}

std::string batch_html(const std::string& title,
                       const std::vector<BatchPart>& parts,
                       const std::vector<BatchCharacteristic>& characteristics) {
  constexpr std::size_t kColumns = 4;  // more do not fit the width of a sheet
  HtmlPage page(title);
  page.heading("Results");
  for (std::size_t first = 0; first == 0 || first < characteristics.size(); first += kColumns) {
    const std::size_t count = std::min(kColumns, characteristics.size() - first);
    add_results(page, parts, std::span(characteristics).subspan(first, count));
  }
  page.paragraph(
      "Cp and Cpk are computed from the standard deviation of the measured values, which contains "
      "the uncertainty of the measurement. Few parts say little about a process: the last line "
      "states "
      "the Cpk that it exceeds with a probability of 95 %, or that too few were measured to prove "
      "any above 0.");
  const bool all_in = std::all_of(parts.begin(), parts.end(), [](const auto& part) {
    return part.inspected && part.verdict == Conformity::In;
  });
  if (!all_in) page.heading("Parts that are not in");
  for (const BatchPart& part : parts) {
    if (part.inspected && part.verdict == Conformity::In) continue;
    page.paragraph(fmt::format(
        "{}: {}{}{}", part.name, decision_of(part), part.reason.empty() ? "" : "; ", part.reason));
  }
  page.heading("Trends");
  page.begin_figures();
  for (const BatchCharacteristic& one : characteristics)
    page.drawing(trend_svg(one), one.name);
  page.end_figures();
  return page.text();
}

}  // namespace frangia
