#include "frangia/report/section_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/report/internal/report_sheets.h"

namespace frangia {
namespace {

using Eigen::Vector2d;

constexpr int kWidth_px = 540;  // of a drawing

/// The path of a curve; y grows downwards in SVG.
std::string path_of(const SectionCurve& curve) {
  std::string path;
  for (std::size_t i = 0; i < curve.points_mm.size(); ++i) {
    const Vector2d& p = curve.points_mm[i];
    path += fmt::format("{}{:.4f} {:.4f}", i == 0 ? "M" : "L", p.x(), -p.y());
  }
  return path + (curve.closed ? "Z" : "");
}

Eigen::AlignedBox2d box_of(const SectionResult& section) {
  Eigen::AlignedBox2d box;
  for (const auto* curves : {&section.measured, &section.reference})
    for (const SectionCurve& curve : *curves)
      for (const Vector2d& p : curve.points_mm)
        box.extend(p);
  return box;
}

double largest_value(const SectionResult& section) {
  double largest = 0.0;
  for (const SectionCurve& curve : section.measured)
    for (const double value : curve.values)
      if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  return largest;
}

/// Lines from the curve along its normal, as long as the enlarged deviations.
std::string whiskers_of(const SectionCurve& curve, double enlarged) {
  std::string path;
  const std::size_t count = curve.points_mm.size();
  if (curve.values.size() != count || count < 3) return path;
  const std::size_t step = std::max<std::size_t>(1, count / 240);
  for (std::size_t i = 0; i < count; i += step) {
    if (!std::isfinite(curve.values[i])) continue;
    const Vector2d& before = curve.points_mm[i == 0 ? (curve.closed ? count - 1 : 0) : i - 1];
    const Vector2d& after = curve.points_mm[i + 1 == count ? (curve.closed ? 0 : i) : i + 1];
    const Vector2d tangent = (after - before).normalized();
    const Vector2d outward(tangent.y(), -tangent.x());  // the material is at the left
    const Vector2d& p = curve.points_mm[i];
    const Vector2d tip = p + enlarged * curve.values[i] * outward;
    if (!tip.allFinite()) continue;
    path += fmt::format("M{:.4f} {:.4f}L{:.4f} {:.4f}", p.x(), -p.y(), tip.x(), -tip.y());
  }
  return path;
}

/// A round length of about a fifth of the width, for the scale bar.
double round_length(double width) {
  const double power = std::pow(10.0, std::floor(std::log10(0.2 * width)));
  double length = power;
  for (const double factor : {2.0, 5.0})
    if (factor * power <= 0.25 * width) length = factor * power;
  return length;
}

/// A place for a text beside the line of a dimension that overlaps no other; the last that was
/// tried, where all do.
Eigen::AlignedBox2d text_box(const SectionDimension& dimension,
                             const Eigen::AlignedBox2d& page,
                             double text,
                             const std::vector<Eigen::AlignedBox2d>& others) {
  const Vector2d half(0.29 * text * static_cast<double>(report::characters_of(dimension.text)),
                      0.7 * text);
  const Vector2d along = dimension.to_mm - dimension.from_mm;
  Eigen::AlignedBox2d box;
  for (const double share : {0.72, 0.28, 0.5, 1.1, -0.1, 0.9, 0.1}) {
    const Vector2d middle = dimension.from_mm + share * along;
    box = {middle - half, middle + half};
    const bool is_free = std::none_of(
        others.begin(), others.end(), [&](const auto& other) { return box.intersects(other); });
    if (is_free && page.contains(box)) return box;
  }
  return box;
}

std::string drawn_dimensions(const std::vector<SectionDimension>& dimensions,
                             const Eigen::AlignedBox2d& page,
                             double text,
                             double line) {
  std::string lines;
  std::string texts;
  std::vector<Eigen::AlignedBox2d> boxes;
  for (const SectionDimension& dimension : dimensions) {
    const char* const color = !dimension.conformity                      ? "#1c2126"
                              : *dimension.conformity == Conformity::Out ? "#b00020"
                              : *dimension.conformity == Conformity::In  ? "#0a6b2d"
                                                                         : "#8a5a00";
    const Vector2d along = (dimension.to_mm - dimension.from_mm).normalized();
    const Vector2d stroke = 0.5 * text * Vector2d(along.x() - along.y(), along.x() + along.y());
    for (const auto& [from, to] :
         {std::pair(dimension.from_mm, dimension.to_mm),
          std::pair(Vector2d(dimension.from_mm - stroke), Vector2d(dimension.from_mm + stroke)),
          std::pair(Vector2d(dimension.to_mm - stroke), Vector2d(dimension.to_mm + stroke))}) {
      lines += fmt::format(
          "<path d=\"M{:.4f} {:.4f}L{:.4f} {:.4f}\" stroke=\"{}\" stroke-width=\"{:.5f}\"/>\n",
          from.x(),
          -from.y(),
          to.x(),
          -to.y(),
          color,
          line);
    }
    const Eigen::AlignedBox2d box = text_box(dimension, page, text, boxes);
    boxes.push_back(box);
    texts += fmt::format(
        "<rect x=\"{:.4f}\" y=\"{:.4f}\" width=\"{:.4f}\" height=\"{:.4f}\" fill=\"#fff\"/>"
        "<text x=\"{:.4f}\" y=\"{:.4f}\" font-size=\"{:.4f}\" fill=\"{}\" "
        "text-anchor=\"middle\" font-family=\"DejaVu Sans, sans-serif\">{}</text>\n",
        box.min().x(),
        -box.max().y(),
        box.sizes().x(),
        box.sizes().y(),
        box.center().x(),
        -box.center().y() + 0.36 * text,
        text,
        color,
        dimension.text);
  }
  return lines + texts;
}

/// A direction of the part: "x", "-y", or its components.
std::string direction_text(const Eigen::Vector3d& direction) {
  constexpr double kAlong = 1e-6;
  for (Eigen::Index i = 0; i < 3; ++i) {
    if (std::abs(direction[i]) < 1.0 - kAlong) continue;
    return std::string(direction[i] < 0.0 ? "-" : "") + "xyz"[i];
  }
  return fmt::format("({}, {}, {})",
                     report::coordinate_text(direction.x(), 2),
                     report::coordinate_text(direction.y(), 2),
                     report::coordinate_text(direction.z(), 2));
}

void add_dxf_curves(std::string& dxf,
                    const std::vector<SectionCurve>& curves,
                    std::string_view layer) {
  for (const SectionCurve& curve : curves) {
    dxf += fmt::format("  0\nPOLYLINE\n  8\n{}\n 66\n1\n 10\n0.0\n 20\n0.0\n 30\n0.0\n 70\n{}\n",
                       layer,
                       curve.closed ? 1 : 0);
    for (const Vector2d& p : curve.points_mm) {
      dxf += fmt::format(
          "  0\nVERTEX\n  8\n{}\n 10\n{:.5f}\n 20\n{:.5f}\n 30\n0.0\n", layer, p.x(), p.y());
    }
    dxf += fmt::format("  0\nSEQEND\n  8\n{}\n", layer);
  }
}

}  // namespace

std::string svg_of(const SectionResult& section,
                   const std::vector<SectionDimension>& dimensions,
                   const ReportWords& words) {
  const Eigen::AlignedBox2d box = box_of(section);
  require(!box.isEmpty(), "the section has no curve to draw; move its plane into the part");
  const double size = std::max(box.sizes().maxCoeff(), 1e-6);
  const double margin = 0.14 * size;
  const double line = size / 700.0;
  const Vector2d low = box.min() - Vector2d::Constant(margin);
  const Vector2d high = box.max() + Vector2d::Constant(margin);
  const double largest = largest_value(section);
  const double enlarged = largest > 0.0 ? 0.1 * size / largest : 0.0;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" viewBox=\"{:.4f} {:.4f} {:.4f} "
      "{:.4f}\" style=\"background:#fff;border:1px solid #ccd\" fill=\"none\">\n",
      kWidth_px,
      low.x(),
      -high.y(),
      high.x() - low.x(),
      high.y() - low.y());
  for (const SectionCurve& curve : section.measured) {
    svg += fmt::format("<path d=\"{}\" stroke=\"#d24a1e\" stroke-width=\"{:.5f}\"/>\n",
                       whiskers_of(curve, enlarged),
                       0.8 * line);
  }
  for (const SectionCurve& curve : section.reference)
    svg += fmt::format(
        "<path d=\"{}\" stroke=\"#111\" stroke-width=\"{:.5f}\"/>\n", path_of(curve), 1.5 * line);
  for (const SectionCurve& curve : section.measured)
    svg += fmt::format("<path d=\"{}\" stroke=\"#1f5fbf\" stroke-width=\"{:.5f}\"/>\n",
                       path_of(curve),
                       1.5 * line);
  const double bar = round_length(high.x() - low.x());
  const double text = 0.032 * size;
  svg += drawn_dimensions(dimensions, {low, high}, text, line);
  const double y = -low.y() - 0.4 * margin;
  svg += fmt::format(
      "<path d=\"M{0:.4f} {1:.4f}h{2:.4f}\" stroke=\"#111\" stroke-width=\"{3:.5f}\"/>\n"
      "<text x=\"{0:.4f}\" y=\"{4:.4f}\" font-size=\"{5:.4f}\" fill=\"#111\" "
      "font-family=\"DejaVu Sans, sans-serif\">{6}</text>\n"
      "<text class=\"axes\" x=\"{0:.4f}\" y=\"{7:.4f}\" font-size=\"{5:.4f}\" fill=\"#111\" "
      "font-family=\"DejaVu Sans, sans-serif\">{8}</text>\n</svg>\n",
      low.x() + 0.4 * margin,
      y,
      bar,
      3.0 * line,
      y - 0.5 * text,
      text,
      words(fmt::format(
          "{:g} mm{}",
          bar,
          enlarged > 0.0 ? fmt::format("; deviations enlarged {:.0f} times", enlarged) : "")),
      -high.y() + 0.4 * margin,
      fmt::format("→ {}  ↑ {}", direction_text(section.plane.u), direction_text(section.plane.v)));
  return svg;
}

std::string profile_plot(const SectionResult& section,
                         const ToleranceLimits& limits,
                         const ReportWords& words) {
  if (section.measured.empty() || section.measured.front().values.empty()) return {};
  const SectionCurve& curve = section.measured.front();
  const double length = std::max(length_mm(curve), 1e-9);
  const double extent =
      1.1 * std::max({largest_value(section), std::abs(limits.lower), std::abs(limits.upper)});
  constexpr double kWide = 540.0;
  constexpr double kHigh = 200.0;
  constexpr double kLeft = 62.0;
  constexpr double kBottom = 36.0;
  const auto x = [&](double s) { return kLeft + s / length * (kWide - kLeft - 10.0); };
  const auto y = [&](double value) {
    return (kHigh - kBottom) * 0.5 * (1.0 - value / extent) + 4.0;
  };
  std::string path;
  bool pen_down = false;
  double s = 0.0;
  for (std::size_t i = 0; i < curve.points_mm.size(); ++i) {
    if (i > 0) s += (curve.points_mm[i] - curve.points_mm[i - 1]).norm();
    const double value = curve.values[i];
    if (std::isfinite(value))
      path += fmt::format("{}{:.1f} {:.1f}", pen_down ? "L" : "M", x(s), y(value));
    pen_down = std::isfinite(value);
  }
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" viewBox=\"0 0 {} {}\" "
      "style=\"background:#fff;border:1px solid #ccd\" font-family=\"DejaVu Sans, sans-serif\" "
      "font-size=\"12\">\n",
      kWidth_px,
      kWide,
      kHigh);
  for (const double value : {limits.lower, 0.0, limits.upper}) {
    svg += fmt::format(
        "<path d=\"M{:.1f} {:.1f}H{:.1f}\" stroke=\"{}\" stroke-width=\"1\"/>"
        "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{:+.3g}</text>\n",
        kLeft,
        y(value),
        kWide - 10.0,
        value == 0.0 ? "#888" : "#b01818",
        kLeft - 5.0,
        y(value) + 4.0,
        value);
  }
  for (int tick = 0; tick <= 4; ++tick) {
    const double at = length * tick / 4.0;
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{:.0f}</text>\n",
                       x(at),
                       kHigh - 20.0,
                       tick == 4 ? "end" : "middle",
                       at);
  }
  svg += fmt::format(
      "<text x=\"{:.0f}\" y=\"{:.0f}\">{}</text>\n"
      "<path d=\"{}\" fill=\"none\" stroke=\"#1f5fbf\" stroke-width=\"1.3\"/>\n</svg>\n",
      kLeft,
      kHigh - 3.0,
      words("deviation, mm, over the length of the curve, mm"),
      path);
  return svg;
}

std::string dxf_of(const SectionResult& section) {
  std::string dxf =
      "  0\nSECTION\n  2\nHEADER\n  9\n$ACADVER\n  1\nAC1009\n  9\n$INSUNITS\n 70\n4\n"
      "  9\n$MEASUREMENT\n 70\n1\n  0\nENDSEC\n  0\nSECTION\n  2\nTABLES\n"
      "  0\nTABLE\n  2\nLTYPE\n 70\n1\n  0\nLTYPE\n  2\nCONTINUOUS\n 70\n0\n  3\nSolid line\n"
      " 72\n65\n 73\n0\n 40\n0.0\n  0\nENDTAB\n  0\nTABLE\n  2\nLAYER\n 70\n3\n";
  constexpr std::array<std::pair<const char*, int>, 3> kLayers{
      {{"0", 7}, {"REFERENCE", 7}, {"MEASURED", 150}}};
  for (const auto& [layer, color] : kLayers)
    dxf += fmt::format("  0\nLAYER\n  2\n{}\n 70\n0\n 62\n{}\n  6\nCONTINUOUS\n", layer, color);
  dxf += "  0\nENDTAB\n  0\nENDSEC\n  0\nSECTION\n  2\nENTITIES\n";
  add_dxf_curves(dxf, section.reference, "REFERENCE");
  add_dxf_curves(dxf, section.measured, "MEASURED");
  return dxf + "  0\nENDSEC\n  0\nEOF\n";
}

}  // namespace frangia
