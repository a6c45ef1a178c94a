// The annex of a report.
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "frangia/core/text.h"
#include "frangia/report/internal/report_sheets.h"

namespace frangia::report {
namespace {

Rows rows_of(const std::vector<std::pair<std::string, std::string>>& pairs) {
  Rows rows;
  for (const auto& [name, text] : pairs)
    rows.push_back({name, text});
  return rows;
}

void add_deviation(HtmlPage& page, const InspectionReport& report, const ReportWords& words) {
  if (!report.deviation || !report.surface) return;
  const DeviationSummary& d = *report.deviation;
  const SurfaceVerdict& v = *report.surface;
  page.heading("Deviations from the reference");
  const auto extreme = [&](double value, double u95, const Eigen::Vector3d& at) {
    if (!std::isfinite(value)) return words("none");
    return words(fmt::format("{:+.4f}{} at {}",
                             value,
                             std::isfinite(u95) ? fmt::format(" (U95 {:.4f})", u95) : "",
                             place_text(at)));
  };
  const auto share = [&](PatchDecision decision) { return share_text(v.share_of(decision)); };
  Rows rows{
      {"tolerance, mm", fmt::format("{:+.4g} … {:+.4g}", v.rule.limits.lower, v.rule.limits.upper)},
      {"nominal area, less what is excluded and strips along edges, mm²",
       number_text(v.area_mm2, 1)},
      {"strips along edges, which are not judged: width, mm, and share of the nominal area",
       fmt::format("{:.2g}, {}", v.rule.edge_mm.value_or(0.0), share_text(v.edge_share))},
      {"proven in", share(PatchDecision::In)},
      {"proven out", share(PatchDecision::Out)},
      {"within the guard band of a limit", share(PatchDecision::NearLimit)},
      {"not measured well enough", share(PatchDecision::NotWellMeasured)},
      {"not measured", share(PatchDecision::NotMeasured)},
      {"coverage: decided share, and least share of a part that is in",
       share_text(v.coverage) + ", " + share_text(v.rule.min_coverage)},
      {"widest gap, and widest gap of a part that is in, mm",
       words(fmt::format(
           "{:.3g} at {}, {:.3g}", v.gap_mm, place_text(v.gap_at_mm), v.rule.max_gap_mm))},
      {"filter: mean over round patches of, mm", fmt::format("{:.3g}", v.rule.min_feature_mm)},
      {"smallest patch, mm", extreme(v.lowest.deviation_mm, v.lowest.u95_mm, v.lowest.at_mm)},
      {"largest patch, mm", extreme(v.highest.deviation_mm, v.highest.u95_mm, v.highest.at_mm)},
      {"smallest vertex, unfiltered, mm", extreme(d.min_mm, kMissing, d.min_at_mm)},
      {"largest vertex, unfiltered, mm", extreme(d.max_mm, kMissing, d.max_at_mm)},
      {"mean and RMS of the vertices, mm", fmt::format("{:+.4f}, {:.4f}", d.mean_mm, d.rms_mm)},
      {"median standard uncertainty of a vertex and of a patch, mm",
       number_text(d.median_u_mm, 4) + ", " + number_text(v.median_u_mm, 4)},
      {"patches, and effective number of independent ones",
       fmt::format("{}, {}", v.patches, v.independent)},
      {"largest U95 that proves \"in\", and that is measured well, of the half-width",
       share_text(v.rule.max_uncertainty_share) + ", " + share_text(v.rule.well_measured_share())},
      {"least half-width of a tolerance that the measurement is good enough for, mm",
       std::isfinite(v.decidable_mm) ? number_text(v.decidable_mm, 4)
                                     : words("none: too little was measured")}};
  for (const ExcludedBox& box : v.rule.excluded)
    rows.push_back({"excluded by the plan: " + box.name,
                    place_text(box.min_mm) + " … " + place_text(box.max_mm)});
  page.table({"", ""}, with_words(rows, words));
  page.paragraph(
      "Averaging over a patch shrinks noise alone; the systematic part, the calibration, the "
      "alignment "
      "and the temperature keep their size. A patch is out when it lies beyond a limit by the "
      "guard band "
      "of that many independent patches (Bonferroni).");
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
  page.table({"vertices", "number"}, with_words(vertices, words));
}

void add_uncertainty(HtmlPage& page, const InspectionReport& report, const ReportWords& words) {
  page.heading("Uncertainty");
  Rows rows;
  for (const auto& [name, value] : report.uncertainty_mm)
    rows.push_back({name, number_text(value, 5)});
  if (rows.empty()) {
    page.paragraph("The mesh holds no sigma, so no uncertainty is known; the limits alone decide.");
    return;
  }
  page.table({"term", "standard uncertainty, mm"}, with_words(rows, words));
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

void add_annex(HtmlPage& page, const InspectionReport& report, const ReportWords& words) {
  page.html(fmt::format("<h1>{}</h1>\n", page.word("Annex")));
  add_deviation(page, report, words);
  add_uncertainty(page, report, words);
  if (!report.alignment.empty()) {
    page.heading("Alignment");
    page.table({"", ""}, with_words(rows_of(report.alignment), words));
  }
  page.heading("Conditions");
  Rows conditions{{"mesh", report.mesh}, {"created", report.created}, {"software", report.version}};
  for (const auto& [name, text] : report.conditions)
    conditions.push_back({name, text});
  page.table({"", ""}, with_words(conditions, words));
  if (!report.warnings.empty()) page.heading("Warnings");
  for (const std::string& warning : report.warnings)
    page.html(fmt::format("<p>{}</p>\n", html_escaped(words.warning(warning))));
}

}  // namespace frangia::report
