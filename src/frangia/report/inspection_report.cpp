// Above 250 lines: the sections of the page in their order.
#include "frangia/report/inspection_report.h"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/core/atomic_file.h"
#include "frangia/core/percent_text.h"
#include "frangia/report/html_page.h"

namespace frangia {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string number_text(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "";
}

std::string limit_cell(const std::optional<ToleranceLimits>& limits, bool upper) {
  if (!limits) return "";
  return number_text(upper ? limits->upper : limits->lower, 4);
}

Rows rows_of(const std::vector<std::pair<std::string, std::string>>& pairs) {
  Rows rows;
  for (const auto& [name, text] : pairs)
    rows.push_back({name, text});
  return rows;
}

void add_verdict(HtmlPage& page, const InspectionReport& report) {
  bool decided = report.deviation.has_value();
  for (const auto& row : report.characteristics)
    decided = decided || row.limits.has_value();
  if (!decided) return;
  const Conformity verdict = verdict_of(report);
  // Sizes of features have an uncertainty by their points, deviations only by the mesh's sigma.
  const bool unknown = report.deviation && !std::isfinite(report.deviation->median_u_mm);
  const char* const counted =
      unknown ? "but without an uncertainty: the mesh holds no sigma." : "the uncertainty counted.";
  if (verdict == Conformity::In) {
    page.verdict(unknown ? "open" : "good", fmt::format("In tolerance, {}", counted));
  } else if (verdict == Conformity::Out) {
    page.verdict("bad", fmt::format("Out of tolerance, {}", counted));
  } else {
    page.verdict("open",
                 "Undecided: neither conformity nor nonconformity is proven, because a value lies "
                 "within its uncertainty of a limit or is missing.");
  }
  page.paragraph(
      "Decision rule: ISO 14253-1, probability of error 5 %. A value is in when it lies inside of "
      "its limits by 1.645 standard uncertainties, and out when it lies beyond one by as much. The "
      "deviations prove a part out when one of them lies beyond a limit by the guard band that all "
      "of them together need.");
}

void add_deviation(HtmlPage& page, const InspectionReport& report) {
  if (!report.deviation) return;
  const DeviationSummary& d = *report.deviation;
  page.heading("Deviations from the reference");
  page.table({"quantity", "value"},
             {{"tolerance, mm", fmt::format("{:+.4g} to {:+.4g}", d.limits.lower, d.limits.upper)},
              {"compared area, mm²", number_text(d.area_mm2, 1)},
              {"share in", percent_text(d.in_share)},
              {"share out", percent_text(d.out_share)},
              {"share undecided", percent_text(d.undecided_share)},
              {"smallest, mm", fmt::format("{:+.4f}", d.min_mm)},
              {"largest, mm", fmt::format("{:+.4f}", d.max_mm)},
              {"mean, mm", fmt::format("{:+.4f}", d.mean_mm)},
              {"RMS, mm", number_text(d.rms_mm, 4)},
              {"median standard uncertainty, mm", number_text(d.median_u_mm, 4)}});
  constexpr std::array<const char*, kDeviationStatuses> kReasons{
      "compared",
      "left out: synthesized",
      "left out: at the edge of the mesh",
      "left out: at the edge of the reference",
      "left out: at a sharp edge, which is rounded by the distance of the points",
      "left out: the nearest surface faces the other way",
      "left out: too far from the reference",
      "left out: without a triangle"};
  Rows vertices;
  for (std::size_t i = 0; i < kDeviationStatuses; ++i) {
    if (i == 0 || d.count.at(i) > 0)
      vertices.push_back({kReasons.at(i), fmt::format("{}", d.count.at(i))});
  }
  page.table({"vertices", "number"}, vertices);
}

void add_walls(HtmlPage& page, const InspectionReport& report) {
  if (!report.thickness) return;
  const ThicknessSummary& t = *report.thickness;
  page.heading("Thickness of the walls");
  const Eigen::Vector3d& at = t.min_at_mm;
  page.table({"quantity", "value"},
             {{"measured area, mm²", number_text(t.area_mm2, 1)},
              {"smallest, mm", number_text(t.min_mm, 4)},
              {"its standard uncertainty, mm", number_text(t.min_u_mm, 4)},
              {"its place, mm", fmt::format("{:.2f} {:.2f} {:.2f}", at.x(), at.y(), at.z())},
              {"5 % of the area is below, mm", number_text(t.p5_mm, 4)},
              {"median, mm", number_text(t.median_mm, 4)},
              {"mean, mm", number_text(t.mean_mm, 4)},
              {"5 % of the area is above, mm", number_text(t.p95_mm, 4)},
              {"largest, mm", number_text(t.max_mm, 4)}});
  constexpr std::array<const char*, kThicknessStatuses> kWallReasons{
      "measured",
      "left out: a wall is synthesized",
      "left out: at the edge of the mesh",
      "left out: no opposite wall",
      "left out: the opposite wall is inclined by more than 45 degrees",
      "left out: at a sharp edge",
      "left out: without a triangle"};
  Rows vertices;
  for (std::size_t i = 0; i < kThicknessStatuses; ++i) {
    if (i == 0 || t.count.at(i) > 0)
      vertices.push_back({kWallReasons.at(i), fmt::format("{}", t.count.at(i))});
  }
  page.table({"vertices", "number"}, vertices);
}

void add_characteristics(HtmlPage& page, const std::vector<MeasuredCharacteristic>& list) {
  if (list.empty()) return;
  page.heading("Characteristics");
  Rows rows;
  for (const MeasuredCharacteristic& row : list) {
    rows.push_back({row.name,
                    row.unit,
                    row.nominal ? number_text(*row.nominal, 4) : "",
                    limit_cell(row.limits, false),
                    limit_cell(row.limits, true),
                    std::isfinite(row.value) ? number_text(row.value, 4) : "not found",
                    number_text(row.u95, 4),
                    row.limits ? std::string(name_of(row.conformity)) : ""});
  }
  page.table({"characteristic", "unit", "nominal", "lower", "upper", "measured", "U95", "decision"},
             rows);
}

void add_found_features(HtmlPage& page, const InspectionReport& report) {
  if (report.features.empty()) return;
  page.heading("Features that were found");
  Rows rows;
  for (std::size_t i = 0; i < report.features.size(); ++i) {
    const Feature& feature = report.features[i];
    const Shape& shape = feature.fit.shape;
    const bool round = shape.kind != ShapeKind::Plane && shape.kind != ShapeKind::Line;
    const bool fitted = is_surface(shape.kind);
    const Eigen::Vector3d& c = shape.center_mm;
    const Eigen::Vector3d& a = shape.axis;
    rows.push_back({std::string(name_of(shape.kind)) + (feature.hole && round ? ", hole" : ""),
                    round ? number_text(2.0 * shape.radius_mm, 4) : "",
                    number_text(feature.uncertainty.u95_mm, 4),
                    fitted ? number_text(feature.fit.form_mm, 4) : "",
                    fmt::format("{:.3f} {:.3f} {:.3f}", c.x(), c.y(), c.z()),
                    shape.kind == ShapeKind::Sphere
                        ? ""
                        : fmt::format("{:.4f} {:.4f} {:.4f}", a.x(), a.y(), a.z()),
                    fmt::format("{}", feature.fit.points)});
    if (report.nominals.empty()) continue;
    const std::optional<NominalFace>& nominal = report.nominals[i];
    const double size =
        nominal && round ? 2.0 * nominal->shape.radius_mm : static_cast<double>(kMissing);
    const std::vector<std::string> cells{
        nominal ? fmt::format("{}", nominal->number) : "",
        number_text(size, 4),
        std::isfinite(size) ? fmt::format("{:+.4f}", 2.0 * shape.radius_mm - size) : ""};
    rows.back().insert(rows.back().begin() + 2, cells.begin(), cells.end());
  }
  std::vector<std::string> names{
      "feature", "diameter, mm", "U95, mm", "form, mm", "center, mm", "axis", "points"};
  if (!report.nominals.empty())
    names.insert(names.begin() + 2, {"CAD face", "nominal, mm", "difference, mm"});
  page.table(names, rows);
}

void add_blades(HtmlPage& page, const std::vector<SectionResult>& sections) {
  Rows rows;
  const BladeSection* first = nullptr;
  const BladeSection* first_nominal = nullptr;
  const auto row =
      [](const std::string& name, const BladeSection& blade, const BladeSection& base) {
        return std::vector<std::string>{
            name,
            number_text(blade.chord_mm, 3),
            number_text(blade.max_thickness_mm, 3),
            number_text(blade.leading_radius_mm, 3),
            number_text(blade.trailing_radius_mm, 3),
            number_text(deg_from_rad(blade.stagger_rad), 3),
            number_text(deg_from_rad(blade.stagger_rad - base.stagger_rad), 3),
            number_text(blade.max_camber_mm, 3)};
      };
  for (const SectionResult& section : sections) {
    if (section.blade) {
      if (first == nullptr) first = &*section.blade;
      rows.push_back(row(section.name, *section.blade, *first));
    }
    if (section.nominal_blade) {
      if (first_nominal == nullptr) first_nominal = &*section.nominal_blade;
      rows.push_back(row(section.name + ", nominal", *section.nominal_blade, *first_nominal));
    }
  }
  if (rows.empty()) return;
  page.heading("Blade sections");
  page.table({"section",
              "chord, mm",
              "largest thickness, mm",
              "leading radius, mm",
              "trailing radius, mm",
              "stagger, degrees",
              "twist, degrees",
              "camber, mm"},
             rows);
}

void add_sections(HtmlPage& page, const InspectionReport& report) {
  if (report.sections.empty()) return;
  page.heading("Sections");
  page.paragraph(
      "Black: reference. Blue: measured. Red: deviations along the normal, enlarged as stated.");
  for (const SectionResult& section : report.sections) {
    const Eigen::Vector3d& p = section.plane.point_mm;
    const Eigen::Vector3d& n = section.plane.normal;
    const std::string place =
        fmt::format("{}: through ({:g}, {:g}, {:g}), normal ({:g}, {:g}, {:g})",
                    section.name,
                    p.x(),
                    p.y(),
                    p.z(),
                    n.x(),
                    n.y(),
                    n.z());
    if (section.measured.empty()) {
      page.paragraph(place + ": the plane does not cut the measured surface");
      continue;
    }
    page.begin_figures();
    page.drawing(svg_of(section), place);
    const ToleranceLimits limits =
        report.deviation ? report.deviation->limits : ToleranceLimits{-0.1, 0.1};
    const std::string plot = profile_plot(section, limits);
    if (!plot.empty()) page.drawing(plot, section.name + ": deviation along the longest curve");
    page.end_figures();
  }
}

void add_uncertainty(HtmlPage& page, const InspectionReport& report) {
  page.heading("Uncertainty");
  Rows rows;
  for (const auto& [name, value] : report.uncertainty_mm)
    rows.push_back({name, number_text(value, 5)});
  if (rows.empty()) {
    page.paragraph("The mesh holds no sigma, so no uncertainty is known; the limits alone decide.");
    return;
  }
  page.table({"term", "standard uncertainty, mm"}, rows);
  if (report.correlation_known) {
    page.paragraph(
        "The covariance of the rig's parameters is propagated to the features: each independent "
        "change moves all points of the part together, so that sizes, distances and angles hold "
        "the "
        "correlation of their errors.");
  } else if (report.systematic_known) {
    page.paragraph(
        "The systematic part of sigma is propagated as one error that is alike in all points of a "
        "feature. Correlation between features is not included: that needs the scan, with a rig "
        "whose calibration has a covariance.");
  } else {
    page.paragraph(
        "The mesh states no systematic part of sigma: the calibration of the rig and the "
        "correlation of its errors are not included.");
  }
}

}  // namespace

Conformity verdict_of(const InspectionReport& report) {
  const Conformity rows = overall(report.characteristics);
  bool limited = false;
  for (const auto& row : report.characteristics)
    limited = limited || row.limits.has_value();
  if (!report.deviation) return rows;
  const Conformity deviation = report.deviation->verdict;
  if (!limited) return deviation;
  if (rows == Conformity::Out || deviation == Conformity::Out) return Conformity::Out;
  const bool both = rows == Conformity::In && deviation == Conformity::In;
  return both ? Conformity::In : Conformity::Undecided;
}

std::string html_of(const InspectionReport& report) {
  HtmlPage page(report.part.empty() ? "Inspection report" : "Inspection report: " + report.part);
  add_verdict(page, report);
  Rows conditions{{"mesh", report.mesh}, {"created", report.created}, {"software", report.version}};
  for (const auto& [name, text] : report.conditions)
    conditions.push_back({name, text});
  page.heading("Conditions");
  page.table({"", ""}, conditions);
  for (const std::string& warning : report.warnings)
    page.verdict("open", warning);
  if (!report.alignment.empty()) {
    page.heading("Alignment");
    page.table({"", ""}, rows_of(report.alignment));
  }
  add_deviation(page, report);
  add_walls(page, report);
  if (!report.pictures.empty()) {
    page.begin_figures();
    for (const ReportPicture& one : report.pictures)
      page.picture(one.picture, one.caption);
    page.end_figures();
  }
  add_characteristics(page, report.characteristics);
  add_blades(page, report.sections);
  add_sections(page, report);
  add_found_features(page, report);
  add_uncertainty(page, report);
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

void write_report_text(const std::filesystem::path& path, const std::string& text) {
  AtomicFile file(path);
  file.stream() << text;
  file.commit();
}

}  // namespace frangia
