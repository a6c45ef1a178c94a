#include "frangia/report/labelled_picture.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "frangia/core/text.h"
#include "frangia/frames/encode_picture.h"
#include "frangia/inspect/deviation.h"
#include "frangia/page/html_page.h"
#include "frangia/report/internal/report_sheets.h"

namespace frangia {

double deviation_scale_mm(double scale_mm, const ToleranceLimits& limits) {
  constexpr double kBeyond = 1.5;
  if (scale_mm > 0.0) return scale_mm;
  return kBeyond * std::max(std::abs(limits.lower), std::abs(limits.upper));
}

RenderOptions deviation_picture(const Mesh& mesh,
                                const SurfaceInspection& surface,
                                double scale_mm) {
  constexpr std::size_t kBins = 60;
  RenderOptions options;
  const ToleranceLimits& limits = surface.verdict.rule.limits;
  const double scale = deviation_scale_mm(scale_mm, limits);
  options.values = surface.deviations.deviation_mm;
  options.value_max = static_cast<float>(scale);
  options.value_min = -options.value_max;
  options.color_map = ColorMap::Diverging;
  options.value_label = "deviation, mm";
  options.histogram = deviation_histogram(mesh, options.values, -scale, scale, kBins);
  options.value_limits = {limits.lower, limits.upper};
  return options;
}

RenderOptions thickness_picture(const Mesh& mesh, const MeasuredWalls& walls, double scale_mm) {
  constexpr std::size_t kBins = 60;
  RenderOptions options;
  options.values = walls.thickness.thickness_mm;
  options.value_label = "thickness, mm";
  const double top = scale_mm > 0.0                        ? scale_mm
                     : std::isfinite(walls.summary.p95_mm) ? 1.1 * walls.summary.p95_mm
                                                           : 1.0;
  options.value_max = static_cast<float>(top);
  options.histogram = deviation_histogram(mesh, options.values, 0.0, top, kBins);
  return options;
}

namespace {

constexpr double kSheetWidth_mm = 182.0;  // A4 less its margins
constexpr double kBoxInset_px = 4.0;      // of a label in its column

const char* color_of_label(std::optional<Conformity> conformity) {
  if (!conformity) return "#3a434d";
  if (conformity == Conformity::Out) return "#b00020";
  return conformity == Conformity::In ? "#0a6b2d" : "#8a5a00";
}

constexpr std::size_t kTextCharacters = 17;    // of a value, in its full size
constexpr std::size_t kDetailCharacters = 21;  // of a line of what it is
constexpr std::size_t kMostLines = 2;

/// Where the character begins that a number of characters precede; the end where there are fewer.
std::size_t byte_of(const std::string& text, std::size_t characters) {
  std::size_t bytes = 0;
  for (; bytes < text.size(); ++bytes) {
    const bool begins = (static_cast<unsigned char>(text[bytes]) & 0xC0U) != 0x80U;
    if (begins && characters-- == 0) break;
  }
  return bytes;
}

/// A text in lines that fit their box, broken at spaces where there are any; the last is shortened.
std::vector<std::string> lines_of(std::string text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    std::size_t end = byte_of(text, kDetailCharacters);
    if (end == text.size()) {
      lines.push_back(text);
      break;
    }
    if (lines.size() + 1 == kMostLines) {
      lines.push_back(text.substr(0, byte_of(text, kDetailCharacters - 1)) + "…");
      break;
    }
    const std::size_t space = text.rfind(' ', end);
    if (space != std::string::npos && space > 0) end = space;
    lines.push_back(text.substr(0, end));
    text.erase(0, text[end] == ' ' ? end + 1 : end);
  }
  return lines;
}

/// Boxes with room for the lines of all labels.
LabelLayout layout_of(const std::vector<PictureLabel>& labels, const ReportWords& words) {
  LabelLayout layout;
  std::size_t lines = 0;
  for (const PictureLabel& label : labels)
    lines = std::max(lines, lines_of(words(label.detail)).size());
  constexpr double kLine_px = 13.0;
  if (lines > 1) layout.height_px += kLine_px * static_cast<double>(lines - 1);
  if (lines == 0 && !labels.empty()) {  // a line each: room for more
    constexpr std::size_t kShort = 32;
    layout = {22.0, 4.0, kShort};
  }
  return layout;
}

std::string drawn_label(const PictureLabel& label,
                        const LabelBox& box,
                        double width_px,
                        double height,
                        const ReportWords& words) {
  const double wide = kLabelColumn_px - 2.0 * kBoxInset_px;
  const double left = kBoxInset_px + (box.right ? kLabelColumn_px + width_px : 0.0);
  const double edge = box.right ? left : left + wide;
  const double x = kLabelColumn_px + label.at_px.x();
  const char* color = color_of_label(label.conformity);
  const std::string text = words(label.text);
  // A number is never cut: a long one is smaller.
  const double room = static_cast<double>(kTextCharacters);
  const double size =
      15.0 *
      std::min(1.0,
               room / static_cast<double>(std::max<std::size_t>(1, report::characters_of(text))));
  std::string svg = fmt::format(
      "<path d=\"M{0:.1f} {1:.1f}L{2:.1f} {3:.1f}\" stroke=\"#fff\" stroke-width=\"3\"/>"
      "<path d=\"M{0:.1f} {1:.1f}L{2:.1f} {3:.1f}\" stroke=\"#1c2126\" stroke-width=\"1\"/>"
      "<circle cx=\"{2:.1f}\" cy=\"{3:.1f}\" r=\"3.5\" fill=\"{4}\" stroke=\"#fff\"/>"
      "<rect class=\"label\" x=\"{5:.1f}\" y=\"{6:.1f}\" width=\"{7:.1f}\" height=\"{8:.1f}\" "
      "rx=\"3\" fill=\"#fff\" stroke=\"{4}\" stroke-width=\"1.2\"/>"
      "<text x=\"{9:.1f}\" y=\"{10:.1f}\" font-size=\"{12:.3g}\" font-weight=\"700\" "
      "fill=\"{4}\">{11}</text>",
      edge,
      box.top_px + 0.5 * height,
      x,
      label.at_px.y(),
      color,
      left,
      box.top_px,
      wide,
      height,
      left + 6.0,
      box.top_px + 16.5,
      html_escaped(text),
      size);
  double baseline = box.top_px + 32.0;
  for (const std::string& line : lines_of(words(label.detail))) {
    svg +=
        fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"12.5\" fill=\"#1c2126\">{}</text>",
                    left + 6.0,
                    baseline,
                    html_escaped(line));
    baseline += 13.0;
  }
  return svg + "\n";
}

std::string hex_color(ColorMap map, double share) {
  const Eigen::Vector3f color = color_of(map, static_cast<float>(share));
  const auto part = [&](int i) { return static_cast<int>(std::lround(255.0F * color[i])); };
  return fmt::format("#{:02x}{:02x}{:02x}", part(0), part(1), part(2));
}

std::string drawn_scale(const PictureScale& scale, const ReportWords& words) {
  constexpr double kWide = 1060.0;
  constexpr double kFrom = 330.0;
  constexpr double kLong = 560.0;
  constexpr int kSteps = 56;
  std::string svg = fmt::format(
      "<svg viewBox=\"0 0 {:g} 40\" width=\"{:g}\" height=\"40\" font-family=\"DejaVu Sans, "
      "sans-serif\" "
      "font-size=\"14\" style=\"width:{}mm;height:6.87mm\"><text x=\"{:g}\" y=\"14\" "
      "text-anchor=\"end\">{}</text>",
      kWide,
      kWide,
      kSheetWidth_mm,
      kFrom - 18.0,
      html_escaped(words(scale.quantity)));
  for (int i = 0; i < kSteps; ++i) {
    svg += fmt::format("<rect x=\"{:.2f}\" y=\"2\" width=\"{:.2f}\" height=\"14\" fill=\"{}\"/>",
                       kFrom + kLong * i / kSteps,
                       kLong / kSteps + 0.4,
                       hex_color(scale.color_map, (i + 0.5) / kSteps));
  }
  std::vector<double> ticks{scale.low, scale.high};
  if (scale.low < 0.0 && scale.high > 0.0) ticks.push_back(0.0);
  if (scale.limits) {
    ticks.push_back(scale.limits->lower);
    ticks.push_back(scale.limits->upper);
  }
  std::set<long> used;  // places of texts, in their width
  for (std::size_t i = ticks.size(); i-- > 0;) {
    const double share = (ticks[i] - scale.low) / (scale.high - scale.low);
    if (!(share >= 0.0 && share <= 1.0)) continue;
    const double x = kFrom + share * kLong;
    constexpr double kTextWide = 62.0;
    const long cell = std::lround(x);
    const bool crowded = std::any_of(used.begin(), used.end(), [&](long other) {
      return std::abs(static_cast<double>(other) - x) < kTextWide;
    });
    if (crowded) continue;
    used.insert(cell);
    const bool limit = i >= 2 && scale.limits &&
                       (ticks[i] == scale.limits->lower || ticks[i] == scale.limits->upper);
    svg += fmt::format(
        "<path d=\"M{0:.1f} 0V20\" stroke=\"#1c2126\" stroke-width=\"{1}\"/><text x=\"{0:.1f}\" "
        "y=\"35\" text-anchor=\"middle\">{2}</text>",
        x,
        limit ? 2.5 : 1.0,
        scale.low < 0.0 && ticks[i] != 0.0 ? fmt::format("{:+.3g}", ticks[i])
                                           : fmt::format("{:.3g}", ticks[i]));
  }
  return svg + "</svg>";
}

}  // namespace

std::string labelled_picture(const ReportPicture& picture, const ReportWords& words) {
  const double wide = picture.picture.width();
  const double high = picture.picture.height();
  const double total = wide + 2.0 * kLabelColumn_px;
  const double height_mm = kSheetWidth_mm * high / total;
  std::string html = fmt::format(
      "<figure><div class=\"labelled\" style=\"width:{0}mm;height:{1:.2f}mm\"><img alt=\"{2}\" "
      "src=\"{3}\"><svg viewBox=\"0 0 {4:g} {5:g}\" width=\"{4:g}\" height=\"{5:g}\" "
      "style=\"width:{0}mm;height:{1:.2f}mm\" font-family=\"DejaVu Sans, sans-serif\" "
      "fill=\"none\">\n",
      kSheetWidth_mm,
      height_mm,
      html_escaped(words(picture.caption)),
      data_uri("image/png", encode_picture(picture.picture)),
      total,
      high);
  const LabelLayout layout = layout_of(picture.labels, words);
  for (const LabelBox& box : place_labels(picture.labels, wide, high, layout))
    html += drawn_label(picture.labels[box.label], box, wide, layout.height_px, words);
  html += "</svg></div>";
  if (picture.scale) html += drawn_scale(*picture.scale, words);
  return html + fmt::format("<figcaption>{}</figcaption></figure>\n",
                            html_escaped(words(picture.caption)));
}

namespace {

/// Moves the boxes of a column apart: pooled neighbors share the mean of what each would like
/// (isotonic regression by pooling adjacent violators).
void spread(std::vector<LabelBox>& boxes, double height_px, double step, double box_height) {
  struct Pool {
    double sum = 0.0;
    std::size_t count = 0;
    [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
  };
  std::vector<Pool> pools;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    pools.push_back({boxes[i].top_px - static_cast<double>(i) * step, 1});
    while (pools.size() > 1 && pools[pools.size() - 2].mean() >= pools.back().mean()) {
      pools[pools.size() - 2].sum += pools.back().sum;
      pools[pools.size() - 2].count += pools.back().count;
      pools.pop_back();
    }
  }
  const double most = height_px - box_height - step * static_cast<double>(boxes.size() - 1);
  std::size_t next = 0;
  for (const Pool& pool : pools) {
    for (std::size_t k = 0; k < pool.count; ++k, ++next) {
      boxes[next].top_px =
          std::clamp(pool.mean(), 0.0, std::max(0.0, most)) + static_cast<double>(next) * step;
    }
  }
}

}  // namespace

std::vector<LabelBox> place_labels(const std::vector<PictureLabel>& labels,
                                   double width_px,
                                   double height_px,
                                   const LabelLayout& layout) {
  const double step = layout.height_px + layout.gap_px;
  const auto room = static_cast<std::size_t>((height_px + layout.gap_px) / step);
  std::vector<std::size_t> kept(std::min({labels.size(), layout.most, 2 * room}));
  std::iota(kept.begin(), kept.end(), std::size_t{0});
  std::stable_sort(kept.begin(), kept.end(), [&](std::size_t a, std::size_t b) {
    return labels[a].at_px.x() < labels[b].at_px.x();
  });
  // Each label goes to its side; what does not fit there goes to the other one.
  auto left = static_cast<std::size_t>(std::count_if(kept.begin(), kept.end(), [&](std::size_t i) {
    return labels[i].at_px.x() < 0.5 * width_px;
  }));
  left = std::clamp(left, kept.size() > room ? kept.size() - room : 0, std::min(room, kept.size()));
  std::vector<LabelBox> placed;
  for (const bool right : {false, true}) {
    std::vector<LabelBox> column;
    for (std::size_t i = right ? left : 0; i < (right ? kept.size() : left); ++i)
      column.push_back({kept[i], right, labels[kept[i]].at_px.y() - 0.5 * layout.height_px});
    if (column.empty()) continue;
    std::stable_sort(column.begin(), column.end(), [](const LabelBox& a, const LabelBox& b) {
      return a.top_px < b.top_px;
    });
    spread(column, height_px, step, layout.height_px);
    placed.insert(placed.end(), column.begin(), column.end());
  }
  return placed;
}

}  // namespace frangia
