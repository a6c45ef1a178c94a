#include "frangia/acceptance/certificate.h"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/page/html_page.h"

namespace frangia {
namespace {

std::string micrometers(double mm) {
  return fmt::format("{:+.1f}", std::round(1e4 * mm) / 10.0 + 0.0);  // no -0.0
}

std::string unsigned_micrometers(double mm) {
  return fmt::format("{:.1f}", 1e3 * mm);
}

void add_quantities(HtmlPage& page,
                    const std::vector<ArrangementResult>& arrangements,
                    const AcceptanceResult& result) {
  page.heading("Errors");
  std::vector<std::vector<std::string>> rows;
  for (const AcceptanceQuantity& quantity : result.quantities) {
    rows.push_back(
        {quantity.name,
         quantity.symbol,
         quantity.is_form ? unsigned_micrometers(quantity.error_mm)
                          : micrometers(quantity.error_mm),
         unsigned_micrometers(quantity.u95_mm),
         quantity.limit_mm ? unsigned_micrometers(*quantity.limit_mm) : "",
         quantity.limit_mm ? std::string(name_of(quantity.conformity)) : "not judged",
         fmt::format("{}: {}", quantity.arrangement + 1, arrangements[quantity.arrangement].name)});
  }
  page.table({"quantity", "symbol", "worst µm", "U95 µm", "limit µm", "decision", "arrangement"},
             rows);
  page.paragraph(
      "An error is in where it lies within its limit by more than the guard band of ISO 14253-1 "
      "(5 % risk), out where it lies beyond it by as much. U95 is the uncertainty of the artifact: "
      "its calibration, form and temperature. What the scanner itself adds is what is tested.");
}

void add_arrangements(HtmlPage& page,
                      const AcceptancePlan& plan,
                      const std::vector<ArrangementResult>& arrangements) {
  page.heading("Arrangements");
  const bool bar = plan.artifact.diameters_mm.size() == 2;
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < arrangements.size(); ++i) {
    const MeasuredArtifact& measured = arrangements[i].measured;
    for (std::size_t b = 0; b < measured.balls.size(); ++b) {
      const MeasuredBall& ball = measured.balls[b];
      const auto once = [&](double error) {
        if (b > 0 || !bar) return std::string();
        return std::isfinite(error) ? micrometers(error) : std::string("not seen");
      };
      const double nominal = bar ? plan.artifact.spacing_mm + 0.5 * (plan.artifact.diameters_mm[0] +
                                                                     plan.artifact.diameters_mm[1])
                                 : 0.0;
      rows.push_back({b == 0 ? fmt::format("{}: {}", i + 1, arrangements[i].name) : "",
                      fmt::format("{}", b + 1),
                      micrometers(ball.diameter_mm - plan.artifact.diameters_mm[b]),
                      unsigned_micrometers(ball.form_95_mm),
                      unsigned_micrometers(ball.form_all_mm),
                      fmt::format("{}", ball.points),
                      fmt::format("{:.0f} %", 100.0 * ball.seen),
                      once(measured.spacing_mm - plan.artifact.spacing_mm),
                      once(measured.length_mm - nominal)});
    }
  }
  page.table({"arrangement",
              "ball",
              "size µm",
              "form 95 % µm",
              "form µm",
              "points",
              "seen",
              "spacing µm",
              "length µm"},
             rows);
}

void add_conditions(HtmlPage& page, const AcceptancePlan& plan, const CertificateFacts& facts) {
  const ReferenceArtifact& artifact = plan.artifact;
  page.heading("Artifact and conditions");
  std::vector<std::vector<std::string>> rows{
      {"artifact", artifact.diameters_mm.size() == 2 ? "ball bar" : "ball"},
      {"diameters", fmt::format("{:.4f} mm", fmt::join(artifact.diameters_mm, " and "))}};
  if (artifact.spacing_mm > 0.0)
    rows.push_back({"spacing", fmt::format("{:.4f} mm", artifact.spacing_mm)});
  rows.push_back({"their U95", fmt::format("{:.4f} mm", artifact.u95_mm)});
  rows.push_back({"form of the balls", fmt::format("{:.4f} mm", artifact.form_mm)});
  if (!artifact.certificate.empty()) rows.push_back({"its certificate", artifact.certificate});
  rows.push_back({"temperature",
                  fmt::format("{:.1f} ± {:.1f} °C, expansion {:g} 1e-6/K",
                              plan.temperature_c,
                              2.0 * plan.temperature_u_k,
                              artifact.expansion_ppm_per_k)});
  if (plan.volume_mm) {
    rows.push_back({"measuring volume",
                    fmt::format("{:g} x {:g} x {:g} mm",
                                plan.volume_mm->x(),
                                plan.volume_mm->y(),
                                plan.volume_mm->z())});
  }
  if (!facts.rig.empty()) rows.push_back({"rig", facts.rig});
  if (!facts.calibrated.empty()) rows.push_back({"rig calibrated", facts.calibrated});
  for (const auto& [name, text] : plan.conditions)
    rows.push_back({name, text});
  rows.push_back({"measured", facts.created});
  rows.push_back({"software", facts.version});
  page.table({"condition", "value"}, rows);
}

void add_method(HtmlPage& page, const std::vector<ArrangementResult>& arrangements) {
  page.heading("Method");
  page.paragraph(
      "Each arrangement is scanned from all sides and fused into one mesh, as a part is. A ball is "
      "the Gaussian sphere of all its measured vertices but those within 6 degrees of the stem or "
      "of a border of the surface; none is rejected by its residual. Form is the least width of a "
      "concentric shell that holds 95 %, or 99.7 %, of them. The length runs from the median point "
      "of one outer cap of 15 degrees to that of the other, where both are seen. Quantities are "
      "those of VDI/VDE 2634 "
      "part 3, with the symbols of ISO 10360-13 where it has them; the worst of all arrangements "
      "is judged.");
  page.heading("Frames");
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < arrangements.size(); ++i) {
    rows.push_back({fmt::format("{}: {}", i + 1, arrangements[i].scan),
                    fmt::format("{}", arrangements[i].frames),
                    arrangements[i].frames_sha256});
  }
  page.table({"scan", "files", "SHA-256 of its list in frames.sha256"}, rows);
}

}  // namespace

std::string certificate_html(const AcceptancePlan& plan,
                             const std::vector<ArrangementResult>& arrangements,
                             const AcceptanceResult& result,
                             const CertificateFacts& facts) {
  HtmlPage page("Acceptance test of a scanner");
  const char* kind = result.conformity == Conformity::In    ? "good"
                     : result.conformity == Conformity::Out ? "bad"
                                                            : "open";
  page.verdict(result.incomplete.empty() || result.conformity != Conformity::In ? kind : "open",
               sentence_of(result));
  if (plan.source == AcceptanceSource::Simulation)
    page.verdict("open", "Simulated: rendered through the rig, not captured by devices.");
  if (!result.incomplete.empty()) {
    page.paragraph(fmt::format("A test after VDI/VDE 2634 part 3 also needs: {}.",
                               fmt::join(result.incomplete, "; ")));
  }
  for (const std::string& warning : facts.warnings)
    page.paragraph("Warning: " + warning);
  add_quantities(page, arrangements, result);
  add_arrangements(page, plan, arrangements);
  add_conditions(page, plan, facts);
  add_method(page, arrangements);
  return page.text();
}

}  // namespace frangia
