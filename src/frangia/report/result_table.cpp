#include "frangia/report/result_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/text.h"
#include "frangia/inspection/verdict_reasons.h"

namespace frangia {
namespace {

std::string decimal_text(double value) {
  return std::isfinite(value) ? fmt::format("{:.4f}", value) : "";
}

std::string signed_decimal(double value) {
  return std::isfinite(value) ? fmt::format("{:+.4f}", value) : "";
}

/// The tolerance as it stands on a drawing: relative to the nominal value, or the limits.
std::string tolerance_text(const MeasuredCharacteristic& row) {
  if (!row.limits) return "";
  const double from = row.nominal.value_or(0.0);
  const double lower = row.limits->lower - from;
  const double upper = row.limits->upper - from;
  if (!std::isfinite(lower)) return fmt::format("≤ {:.4g}", upper + from);
  if (std::abs(lower + upper) < 1e-9 * std::abs(upper)) return fmt::format("± {:.4g}", upper);
  return fmt::format("{:+.4g}/{:+.4g}", lower, upper);
}

std::string color_of_row(const MeasuredCharacteristic& row) {
  if (row.conformity == Conformity::Out) return "#b00020";
  return row.conformity == Conformity::In ? "#0a8a3d" : "#d99000";
}

}  // namespace

const Extreme& worst_extreme(const SurfaceVerdict& verdict) {
  const ToleranceLimits& limits = verdict.rule.limits;
  const double middle = 0.5 * (limits.lower + limits.upper);
  const double above = verdict.highest.deviation_mm - middle;
  const double below = middle - verdict.lowest.deviation_mm;
  return !std::isfinite(above) || below > above ? verdict.lowest : verdict.highest;
}

MeasuredCharacteristic surface_row(const SurfaceVerdict& verdict) {
  const Extreme& worst = worst_extreme(verdict);
  MeasuredCharacteristic row;
  row.name = fmt::format("surface, mean over {:.3g} mm", verdict.rule.min_feature_mm);
  row.nominal = 0.0;
  row.limits = verdict.rule.limits;
  row.conformity = verdict.conformity;
  row.value = worst.deviation_mm;
  row.u95 = worst.u95_mm;
  return row;
}

std::string tolerance_bar(const MeasuredCharacteristic& row) {
  if (!row.limits || !std::isfinite(row.value)) return "";
  constexpr double kWide = 160.0;
  constexpr double kLow = 32.0;    // of the lower limit
  constexpr double kHigh = 128.0;  // of the upper limit
  const ToleranceLimits& limits = *row.limits;
  const double lower = std::isfinite(limits.lower) ? limits.lower : 0.0;
  const double scale = (kHigh - kLow) / (limits.upper - lower);
  const auto at = [&](double value) { return kLow + scale * (value - lower); };
  const double x = at(row.value);
  std::string svg = fmt::format(
      "<svg viewBox=\"0 0 {0:g} 20\" width=\"{0:g}\" height=\"20\">"
      "<rect x=\"0\" y=\"8\" width=\"{0:g}\" height=\"4\" fill=\"#e4e7ec\"/>"
      "<rect x=\"{1:g}\" y=\"8\" width=\"{2:g}\" height=\"4\" fill=\"#9fc9ae\"/>"
      "<path d=\"M{1:g} 3V17M{3:g} 3V17\" stroke=\"#5a6470\" stroke-width=\"1.5\"/>",
      kWide,
      kLow,
      kHigh - kLow,
      kHigh);
  const std::string color = color_of_row(row);
  if (x < 4.0 || x > kWide - 4.0) {
    const double tip = x < 4.0 ? 1.0 : kWide - 1.0;
    const double back = x < 4.0 ? 10.0 : -10.0;
    svg += fmt::format("<path d=\"M{:g} 10L{:g} 4V16Z\" fill=\"{}\"/>", tip, tip + back, color);
    return svg + "</svg>";
  }
  if (std::isfinite(row.u95)) {
    const double from = std::max(0.0, at(row.value - row.u95));
    const double to = std::min(kWide, at(row.value + row.u95));
    svg += fmt::format(
        "<path d=\"M{:.2f} 10H{:.2f}\" stroke=\"{}\" stroke-width=\"2.5\"/>", from, to, color);
  }
  svg += fmt::format("<circle cx=\"{:.2f}\" cy=\"10\" r=\"4\" fill=\"{}\"/>", x, color);
  return svg + "</svg>";
}

std::string result_table(const std::vector<MeasuredCharacteristic>& rows,
                         std::size_t count,
                         const ReportWords& words) {
  constexpr std::array<std::pair<const char*, const char*>, 9> kColumns{{{"", "characteristic"},
                                                                         {"unit", "unit"},
                                                                         {"value", "nominal"},
                                                                         {"limits", "tolerance"},
                                                                         {"value", "measured"},
                                                                         {"deviation", "deviation"},
                                                                         {"u95", "U95"},
                                                                         {"bar", "tolerance used"},
                                                                         {"decision", "verdict"}}};
  std::string html = "<table class=\"results\"><thead><tr>";
  for (const auto& [kind, name] : kColumns)
    html += fmt::format("<th class=\"{}\">{}</th>", kind, html_escaped(words(name)));
  html += "</tr></thead><tbody>\n";
  for (std::size_t i = 0; i < std::min(count, rows.size()); ++i) {
    const MeasuredCharacteristic& row = rows[i];
    const double deviation = row.nominal ? row.value - *row.nominal : static_cast<double>(kMissing);
    const std::string verdict(row.limits ? name_of(row.conformity) : "");
    html += fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{}</td><td class=\"limits\">{}</td><td>{}</td><td>{}</td>"
        "<td>{}</td>"
        "<td class=\"bar\">{}</td><td class=\"{}\">{}</td></tr>\n",
        html_escaped(words.name(row.name)),
        row.unit == "degrees" ? "°" : row.unit,
        row.nominal ? decimal_text(*row.nominal) : "",
        tolerance_text(row),
        std::isfinite(row.value) ? decimal_text(row.value) : words("not found"),
        signed_decimal(deviation),
        decimal_text(row.u95),
        tolerance_bar(row),
        verdict,
        words(verdict));
    if (!row.reason.empty()) {
      html += fmt::format("<tr><td class=\"why\" colspan=\"9\">{}</td></tr>\n",
                          html_escaped(words.sentence(row.reason)));
    }
  }
  return html + "</tbody></table>\n";
}

}  // namespace frangia
