// What a report shows after its first sheet.
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/angles.h"
#include "frangia/report/internal/report_sheets.h"

namespace frangia::report {
namespace {

std::string point_text(const Eigen::Vector3d& point, int decimals) {
  return fmt::format("{} {} {}",
                     coordinate_text(point.x(), decimals),
                     coordinate_text(point.y(), decimals),
                     coordinate_text(point.z(), decimals));
}

void add_pictures(HtmlPage& page, const InspectionReport& report, const ReportWords& words) {
  if (report.pictures.size() < 2) return;
  page.heading("Pictures");
  for (std::size_t i = 1; i < report.pictures.size(); ++i)
    page.html(labelled_picture(report.pictures[i], words));
}

std::string decision_text(const SurfacePlace& place) {
  if (place.missing) return "out: material is missing";
  switch (place.decision) {
    case PatchDecision::Out:
      return "out";
    case PatchDecision::NearLimit:
      return "within the guard band";
    case PatchDecision::NotWellMeasured:
      return "not measured well enough";
    default:
      return "not measured";
  }
}

void add_places(HtmlPage& page, const InspectionReport& report, const ReportWords& words) {
  constexpr std::size_t kMostPlaces = 12;
  if (!report.surface || report.surface->places.empty()) return;
  page.heading("Places that are out, undecided or not measured");
  Rows rows;
  for (const SurfacePlace& place : report.surface->places) {
    if (rows.size() == kMostPlaces) break;
    rows.push_back(
        {words(decision_text(place)),
         place_text(place.at_mm),
         std::isfinite(place.deviation_mm) ? fmt::format("{:+.4f}", place.deviation_mm) : "",
         number_text(place.u95_mm, 4),
         number_text(place.area_mm2, 1)});
  }
  page.table({"place", "at", "deviation, mm", "U95, mm", "area, mm²"}, rows);
  if (report.surface->places.size() > rows.size())
    page.paragraph(fmt::format(
        "These {} places matter most; the JSON beside this report lists more.", rows.size()));
}

void add_walls(HtmlPage& page, const InspectionReport& report, const ReportWords& words) {
  if (!report.thickness) return;
  const ThicknessSummary& t = *report.thickness;
  page.heading("Thickness of the walls");
  const Eigen::Vector3d& at = t.min_at_mm;
  Rows rows{{"measured area, mm²", number_text(t.area_mm2, 1)},
            {"smallest, mm", number_text(t.min_mm, 4)},
            {"its standard uncertainty, mm", number_text(t.min_u_mm, 4)},
            {"its place, mm", at.allFinite() ? point_text(at, 2) : ""},
            {"5 % of the area is below, mm", number_text(t.p5_mm, 4)},
            {"median, mm", number_text(t.median_mm, 4)},
            {"mean, mm", number_text(t.mean_mm, 4)},
            {"5 % of the area is above, mm", number_text(t.p95_mm, 4)},
            {"largest, mm", number_text(t.max_mm, 4)}};
  page.table({"quantity", "value"}, with_words(rows, words));
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
  page.table({"vertices", "number"}, with_words(vertices, words));
}

void add_found_features(HtmlPage& page, const InspectionReport& report, const ReportWords& words) {
  if (report.features.empty()) return;
  page.heading("Features that were found");
  for (const ReportPicture& picture : report.feature_pictures)
    page.html(labelled_picture(picture, words));
  Rows rows;
  for (std::size_t i = 0; i < report.features.size(); ++i) {
    const Feature& feature = report.features[i];
    const Shape& shape = feature.fit.shape;
    const bool round = shape.kind != ShapeKind::Plane && shape.kind != ShapeKind::Line;
    const bool fitted = is_surface(shape.kind);
    const Eigen::Vector3d& c = shape.center_mm;
    const Eigen::Vector3d& a = shape.axis;
    const std::string name = i < report.feature_names.size() ? report.feature_names[i] : "";
    rows.push_back({words((name.empty() ? "" : name + ": ") + std::string(name_of(shape.kind)) +
                          (feature.hole && round ? ", hole" : "")),
                    fmt::format("{}", i + 1),  // as in the pictures
                    round ? number_text(2.0 * shape.radius_mm, 4) : "",
                    number_text(feature.uncertainty.u95_mm, 4),
                    fitted ? number_text(feature.fit.form_mm, 4) : "",
                    point_text(c, 3),
                    shape.kind == ShapeKind::Sphere ? "" : point_text(a, 4),
                    fmt::format("{}", feature.fit.points)});
    if (report.nominals.empty()) continue;
    const std::optional<NominalFace>& nominal = report.nominals[i];
    const double size =
        nominal && round ? 2.0 * nominal->shape.radius_mm : static_cast<double>(kMissing);
    const std::vector<std::string> cells{
        nominal ? fmt::format("{}", nominal->number) : "",
        number_text(size, 4),
        std::isfinite(size) ? fmt::format("{:+.4f}", 2.0 * shape.radius_mm - size) : ""};
    rows.back().insert(rows.back().begin() + 3, cells.begin(), cells.end());
  }
  std::vector<std::string> names{
      "feature", "no.", "diameter, mm", "U95, mm", "form, mm", "center, mm", "axis", "points"};
  std::vector<double> shares{0.29, 0.05, 0.13, 0.1, 0.1, 0.12, 0.11, 0.1};
  if (!report.nominals.empty()) {
    names.insert(names.begin() + 3, {"CAD face", "nominal, mm", "difference, mm"});
    shares = {0.175, 0.04, 0.115, 0.075, 0.095, 0.1, 0.075, 0.075, 0.09, 0.085, 0.075};
  }
  page.table(names, rows, shares);
}

void add_blades(HtmlPage& page,
                const std::vector<SectionResult>& sections,
                const ReportWords& words) {
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
      rows.push_back(
          row(words.name(section.name + ", nominal"), *section.nominal_blade, *first_nominal));
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

void add_sections(HtmlPage& page, const InspectionReport& report, const ReportWords& words) {
  if (report.sections.empty()) return;
  page.heading("Sections");
  page.html(fmt::format("<p class=\"lead\">{}</p>\n",
                        page.word("Black: reference. Blue: measured. Red: deviations along the "
                                  "normal, enlarged as stated.")));
  for (std::size_t i = 0; i < report.sections.size(); ++i) {
    const SectionResult& section = report.sections[i];
    const auto dimensions =
        i < report.dimensions.size() ? report.dimensions[i] : std::vector<SectionDimension>{};
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
    page.drawing(svg_of(section, dimensions, words), place);
    const ToleranceLimits limits =
        report.surface ? report.surface->rule.limits : ToleranceLimits{-0.1, 0.1};
    const std::string plot = profile_plot(section, limits, words);
    if (!plot.empty()) page.drawing(plot, section.name + ": deviation along the longest curve");
    page.end_figures();
  }
}

}  // namespace

void add_findings(HtmlPage& page, const InspectionReport& report, const ReportWords& words) {
  const ReportFields& fields = report.fields;
  if (fields.prints(ReportPage::Pictures)) add_pictures(page, report, words);
  if (fields.prints(ReportPage::Places)) add_places(page, report, words);
  if (fields.prints(ReportPage::Thickness)) add_walls(page, report, words);
  if (fields.prints(ReportPage::Sections)) {
    add_blades(page, report.sections, words);
    add_sections(page, report, words);
  }
  if (fields.prints(ReportPage::Features)) add_found_features(page, report, words);
}

}  // namespace frangia::report
