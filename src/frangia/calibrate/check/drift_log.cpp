#include "frangia/calibrate/check/drift_log.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/durable_log.h"
#include "frangia/core/error.h"

namespace frangia {
namespace {

constexpr const char* kMark = "drift";  // the first word of a line, for later kinds

/// A text that a tab or a line end does not split.
std::string flat(std::string text) {
  for (char& one : text) {
    if (static_cast<unsigned char>(one) < ' ') one = ' ';
  }
  return text;
}

/// The fields of a line; empty unless it is one of figures.
std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, '\t');)
    fields.push_back(field);
  constexpr std::size_t kFields = 8;
  if (fields.size() != kFields || fields.front() != kMark) return {};
  return fields;
}

bool to_number(const std::string& text, double& number) {
  std::istringstream in(text);
  return static_cast<bool>(in >> number);
}

/// Adds the figure of a line to the entry of its scan.
bool add_line(std::vector<DriftEntry>& entries, const std::string& line) {
  const std::vector<std::string> fields = fields_of(line);
  if (fields.empty()) return false;
  double time_s = 0.0;
  RigCheckItem item;
  item.name = fields[4];
  if (!to_number(fields[1], time_s) || !to_number(fields[5], item.deviation_mm) ||
      !to_number(fields[6], item.sigma_mm) || !to_number(fields[7], item.limit_mm))
    return false;
  const auto same = std::find_if(entries.begin(), entries.end(), [&](const DriftEntry& entry) {
    return entry.time_s == time_s && entry.scan == fields[2];
  });
  DriftEntry& entry = same == entries.end() ? entries.emplace_back() : *same;
  entry.time_s = time_s;
  entry.scan = fields[2];
  entry.kind = fields[3];
  const auto known = std::find_if(entry.items.begin(), entry.items.end(), [&](const auto& other) {
    return other.name == item.name;
  });
  if (known == entry.items.end()) entry.items.push_back(std::move(item));
  return true;
}

}  // namespace

std::filesystem::path drift_log_path(const std::filesystem::path& rig) {
  std::filesystem::path log = rig;
  return log.replace_extension(".drift.txt");
}

std::vector<DriftEntry> read_drift_log(const std::filesystem::path& log, const Run& run) {
  std::vector<DriftEntry> entries;
  if (!std::filesystem::exists(log)) return entries;
  std::size_t damaged = 0;
  const DurableLog file(log);
  for (const LogLine& line : file.lines()) {
    if (line.damaged || !add_line(entries, line.text)) ++damaged;
  }
  if (damaged > 0) {
    run.warn(fmt::format(
        "{}: {} of {} lines are damaged and not used", log.string(), damaged, file.lines().size()));
  }
  std::stable_sort(entries.begin(), entries.end(), [](const auto& one, const auto& other) {
    return one.time_s < other.time_s;
  });
  return entries;
}

void append_drift(const std::filesystem::path& log, const DriftEntry& entry) {
  DurableLog file(log);
  // In milliseconds, as it reads them back.
  const std::string time = fmt::format("{:.3f}", entry.time_s);
  std::vector<DriftEntry> before;
  for (const LogLine& line : file.lines()) {
    if (!line.damaged) add_line(before, line.text);
  }
  double written_s = 0.0;
  to_number(time, written_s);
  const bool known = std::any_of(before.begin(), before.end(), [&](const DriftEntry& other) {
    return other.time_s == written_s && other.scan == flat(entry.scan);
  });
  if (known) return;
  for (const RigCheckItem& item : entry.items) {
    file.append(fmt::format("{}\t{}\t{}\t{}\t{}\t{:.6f}\t{:.6f}\t{:.6f}",
                            kMark,
                            time,
                            flat(entry.scan),
                            flat(entry.kind),
                            flat(item.name),
                            item.deviation_mm,
                            item.sigma_mm,
                            item.limit_mm));
  }
}

std::string utc_text(double seconds_since_1970) {
  const auto whole = static_cast<std::time_t>(std::floor(seconds_since_1970));
  std::tm parts{};
  gmtime_r(&whole, &parts);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z",
                     parts.tm_year + 1900,
                     parts.tm_mon + 1,
                     parts.tm_mday,
                     parts.tm_hour,
                     parts.tm_min,
                     parts.tm_sec);
}

namespace {

constexpr double kPanelWidth = 640.0;
constexpr double kPanelHeight = 150.0;
constexpr double kPlotLeft = 70.0;
constexpr double kPlotRight = 620.0;
constexpr double kPlotTop = 26.0;
constexpr double kPlotBottom = 122.0;

/// A figure at one time.
struct DriftPoint {
  double time_s = 0.0;
  RigCheckItem item;
};

/// Names of figures come from folders and cameras.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char one : text) {
    if (one == '<') {
      out += "&lt;";
    } else if (one == '&') {
      out += "&amp;";
    } else {
      out += one;
    }
  }
  return out;
}

/// One figure over time, in a panel that begins at `top`.
std::string panel_of(const std::string& name,
                     const std::vector<DriftPoint>& points,
                     double first_s,
                     double last_s,
                     double top) {
  double most = 0.0;
  for (const DriftPoint& point : points) {
    if (!std::isfinite(point.item.deviation_mm)) continue;
    most = std::max({most,
                     std::abs(point.item.deviation_mm) + point.item.sigma_mm,
                     std::isfinite(point.item.limit_mm) ? point.item.limit_mm : 0.0});
  }
  if (!(most > 0.0)) most = 1.0;
  most *= 1.1;
  const double middle = 0.5 * (kPlotTop + kPlotBottom);
  const auto x_of = [&](double time_s) {
    const double span = last_s - first_s;
    const double share = span > 0.0 ? (time_s - first_s) / span : 0.5;
    return kPlotLeft + 10.0 + share * (kPlotRight - kPlotLeft - 20.0);
  };
  const auto y_of = [&](double value_mm) {
    return top + middle - 0.5 * (kPlotBottom - kPlotTop) * value_mm / most;
  };
  const double limit_mm = points.back().item.limit_mm;
  std::string svg = fmt::format(
      "<text x=\"{0}\" y=\"{1:.1f}\" font-weight=\"bold\">{2}</text>\n"
      "<rect x=\"{0}\" y=\"{3:.1f}\" width=\"{4}\" height=\"{5}\" fill=\"none\" stroke=\"#888\"/>\n"
      "<line x1=\"{0}\" x2=\"{6}\" y1=\"{7:.1f}\" y2=\"{7:.1f}\" stroke=\"#ccc\"/>\n",
      kPlotLeft,
      top + kPlotTop - 8.0,
      escaped(name),
      top + kPlotTop,
      kPlotRight - kPlotLeft,
      kPlotBottom - kPlotTop,
      kPlotRight,
      y_of(0.0));
  for (const double value : {limit_mm, 0.0, -limit_mm}) {
    if (value != 0.0) {
      svg += fmt::format(
          "<line x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#c33\" "
          "stroke-dasharray=\"5 4\"/>\n",
          kPlotLeft,
          kPlotRight,
          y_of(value),
          y_of(value));
    }
    svg += fmt::format("<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{:+.3g}</text>\n",
                       kPlotLeft - 6.0,
                       y_of(value) + 4.0,
                       value);
  }
  std::string line;
  for (const DriftPoint& point : points) {
    const double value = point.item.deviation_mm;
    if (!std::isfinite(value)) continue;
    const double x = x_of(point.time_s);
    line += fmt::format("{:.1f},{:.1f} ", x, y_of(value));
    svg += fmt::format(
        "<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1:.1f}\" y2=\"{2:.1f}\" stroke=\"#369\"/>\n"
        "<circle cx=\"{0:.1f}\" cy=\"{3:.1f}\" r=\"3\" fill=\"{4}\"><title>{5}: {6:+.4f} ± {7:.4f} "
        "mm</title></circle>\n",
        x,
        y_of(value - point.item.sigma_mm),
        y_of(value + point.item.sigma_mm),
        y_of(value),
        point.item.passed() ? "#369" : "#c33",
        utc_text(point.time_s),
        value,
        point.item.sigma_mm);
  }
  svg += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"#369\"/>\n", line);
  svg += fmt::format("<text x=\"{}\" y=\"{:.1f}\">{}</text>\n",
                     kPlotLeft,
                     top + kPlotBottom + 16.0,
                     utc_text(first_s));
  if (last_s > first_s) {
    svg += fmt::format("<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n",
                       kPlotRight,
                       top + kPlotBottom + 16.0,
                       utc_text(last_s));
  }
  return svg;
}

}  // namespace

std::string drift_plot(std::span<const DriftEntry> entries) {
  std::vector<std::pair<std::string, std::vector<DriftPoint>>> figures;
  for (const DriftEntry& entry : entries) {
    for (const RigCheckItem& item : entry.items) {
      const std::string name = entry.kind + ": " + item.name + ", deviation in mm";
      auto found = std::find_if(
          figures.begin(), figures.end(), [&](const auto& figure) { return figure.first == name; });
      if (found == figures.end()) found = figures.insert(figures.end(), {name, {}});
      found->second.push_back({entry.time_s, item});
    }
  }
  if (figures.empty()) return "";
  const double first_s = entries.front().time_s;
  const double last_s = entries.back().time_s;
  const double height = kPanelHeight * static_cast<double>(figures.size());
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\" font-family=\"sans-serif\" font-size=\"11\">\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>\n",
      kPanelWidth,
      height);
  for (std::size_t i = 0; i < figures.size(); ++i) {
    svg += panel_of(figures[i].first,
                    figures[i].second,
                    first_s,
                    last_s,
                    kPanelHeight * static_cast<double>(i));
  }
  return svg + "</svg>\n";
}

}  // namespace frangia
