#include "frangia/calibrate/report/artifact_report.h"

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/calibrate/internal/artifact_model.h"
#include "frangia/calibrate/report/internal/residual_figure.h"
#include "frangia/calibrate/solve/calibrate_rig.h"
#include "frangia/core/angles.h"
#include "frangia/core/durable_file.h"
#include "frangia/core/text.h"
#include "frangia/page/html_page.h"

namespace frangia {
namespace {

/// Blue for a large negative distance, light grey for none, red for a large positive one.
std::string signed_color(double share) {
  const double strength = std::min(1.0, std::abs(share));
  return fmt::format(
      "hsl({},{:.0f}%,{:.0f}%)", share < 0.0 ? 220 : 5, 90.0 * strength, 78.0 - 33.0 * strength);
}

void add_rig_summary(const ArtifactCalibration& result, std::string& html) {
  const Calibration& calibration = *result.rig.calibration;
  html += fmt::format("<p>By {}, {}, in {} views.</p>\n",
                      html_escaped(calibration.board),
                      calibration.date,
                      calibration.poses);
  if (result.table) {
    html += fmt::format(
        "<p>Grade: <b>{}</b>. The calibration adds {:.4f} mm to the uncertainty of a point at "
        "{:.0f} mm, as its covariance predicts.</p>\n",
        calibration_grade(calibration.point_sigma_mm, calibration.distance_mm),
        calibration.point_sigma_mm,
        calibration.distance_mm);
  }
  html += "<h2>Parameters</h2><table><tr><th></th><th>standard deviation</th></tr>\n";
  for (const auto& [name, sigma] : calibration.sigma)
    if (sigma > 0.0) html += fmt::format("<tr><td>{}</td><td>{:.3g}</td></tr>\n", name, sigma);
  html += "</table>\n";
}

/// The camera by the poses of a screen. A residual in mm is that at the distance of the pose.
void add_screen(const ArtifactCalibration& result, std::string& html) {
  const CameraSolution& camera = *result.camera;
  html += fmt::format(
      "<h2>Camera, by a screen</h2><p>Focal length {:.3f} px, principal point ({:.3f}, {:.3f}) px; "
      "estimated beyond them and k1: {}. The screen deviates from a plane by {:.3f} mm at "
      "most.</p>\n<table><tr><th>pose</th><th>RMS, px</th><th>RMS, mm</th><th>largest, px</th>"
      "<th>distance, mm</th></tr>\n",
      camera.camera.focal_px.x(),
      camera.camera.principal_point_px.x(),
      camera.camera.principal_point_px.y(),
      camera.terms.empty() ? "nothing" : fmt::format("{}", fmt::join(camera.terms, ", ")),
      camera.bend_mm);
  ResidualMap map{.title = "Camera",
                  .width = camera.camera.width_px,
                  .height = camera.camera.height_px,
                  .rms = camera.residuals.rms_px};
  for (std::size_t view = 0; view < result.screens.size(); ++view) {
    const double distance_mm = camera.camera_from_screen[view].translation().norm();
    const ResidualSummary& summary = camera.by_view[view];
    html += fmt::format(
        "<tr><td>{}</td><td>{:.4f}</td><td>{:.4f}</td><td>{:.3f}</td><td>{:.0f}</td></tr>\n",
        html_escaped(result.screens[view].name),
        summary.rms_px,
        summary.rms_px * distance_mm / camera.camera.focal_px.x(),
        summary.max_px,
        distance_mm);
    for (std::size_t i = 0; i < camera.residuals_px[view].size(); ++i) {
      map.arrows.push_back(
          {result.screens[view].points[i].camera_px, camera.residuals_px[view][i]});
    }
  }
  html += "</table>\n<div class=\"row\">\n" + residual_figure(map) + "</div>\n";
}

/// Distances of all views of an artifact over the camera image.
std::string distance_figure(const ArtifactCalibration& result, std::size_t capture) {
  const CameraModel& model = result.rig.reference().model;
  std::vector<ArtifactDistance> all;
  for (std::size_t view = 0; view < result.captures[capture].views.size(); ++view) {
    const std::vector<ArtifactDistance> some = artifact_distances(result, capture, view);
    all.insert(all.end(), some.begin(), some.end());
  }
  const double full_mm = std::max(3.0 * rms_mm(all), 1e-6);
  constexpr std::size_t kMost = 6000;  // points that a picture shows apart
  const std::size_t every = all.size() / kMost + 1;
  std::string html = fmt::format(
      "<figure><svg viewBox=\"0 0 {} {}\" width=\"520\">\n", model.width_px, model.height_px);
  for (std::size_t i = 0; i < all.size(); i += every) {
    html += fmt::format("<circle cx=\"{:.0f}\" cy=\"{:.0f}\" r=\"{:.1f}\" fill=\"{}\"/>\n",
                        all[i].camera_px.x(),
                        all[i].camera_px.y(),
                        model.width_px / 250.0,
                        signed_color(all[i].distance_mm / full_mm));
  }
  return html + fmt::format(
                    "</svg><figcaption>{}: distances of the measured points, RMS {:.4f} mm. "
                    "Blue is -{:.4f} mm or less, red {:.4f} mm or more. A pattern is a "
                    "fault of the rig's model or of the artifact; a random one is "
                    "noise.</figcaption></figure>\n",
                    name_of(result.captures[capture].artifact),
                    rms_mm(all),
                    full_mm,
                    full_mm);
}

void add_views(const ArtifactCalibration& result, std::string& html) {
  html +=
      "<table><tr><th>view</th><th>artifact</th><th>points</th><th>RMS, mm</th><th>largest, mm</th>"
      "<th>angle, °</th><th>error of the angle, °</th></tr>\n";
  for (std::size_t c = 0; c < result.captures.size(); ++c) {
    const ArtifactCapture& capture = result.captures[c];
    for (std::size_t v = 0; v < capture.views.size(); ++v) {
      const std::vector<ArtifactDistance> distances = artifact_distances(result, c, v);
      double largest_mm = 0.0;
      for (const ArtifactDistance& one : distances)
        largest_mm = std::max(largest_mm, std::abs(one.distance_mm));
      html += fmt::format(
          "<tr><td>{}</td><td>{}</td><td>{}</td><td>{:.4f}</td><td>{:.4f}</td><td>{:.3f}</td>"
          "<td>{:.4f}</td></tr>\n",
          html_escaped(capture.views[v].name),
          name_of(capture.artifact),
          distances.size(),
          rms_mm(distances),
          largest_mm,
          deg_from_rad(capture.views[v].angle_rad),
          deg_from_rad(result.table->angle_errors_rad[c][v]));
    }
  }
  html += "</table>\n";
}

void add_table(const ArtifactCalibration& result, std::string& html) {
  const ArtifactSolution& table = *result.table;
  html += fmt::format(
      "<h2>Projector and turntable</h2><p>The axis of the turntable is known within {:.4f}° and "
      "{:.4f} mm; its angles deviate by {:.4f}°. The light deviates by {:.4f} % of its range. "
      "Held, because the data leaves them open: {}.</p>\n",
      deg_from_rad(table.axis_sigma_rad),
      table.point_sigma_mm,
      deg_from_rad(table.angle_sigma_rad),
      100.0 * table.light_rms / result.light_range,
      fmt::join(table.held, ", "));
  for (std::size_t c = 0; c < result.captures.size(); ++c) {
    const auto* balls = std::get_if<Balls>(&result.captures[c].artifact);
    if (balls == nullptr) continue;
    html += fmt::format("<p>Diameters {:.4f} mm; stated {:g} mm.</p>\n",
                        fmt::join(table.diameters_mm[c], " mm and "),
                        balls->diameter_mm);
  }
  if (table.line_rms_mm > 0.0) {
    html +=
        fmt::format("<p>The laser line is {:.4f} mm RMS off its sheet.</p>\n", table.line_rms_mm);
  }
  html += "<div class=\"row\">\n";
  for (std::size_t c = 0; c < result.captures.size(); ++c)
    html += distance_figure(result, c);
  html += "</div>\n";
  add_views(result, html);
}

}  // namespace

void write_artifact_report(const std::filesystem::path& path,
                           const ArtifactCalibration& result,
                           std::span<const std::string> warnings) {
  HtmlPage page("Calibration");
  std::string html;
  add_rig_summary(result, html);
  page.html(html);
  for (const std::string& warning : warnings)
    page.verdict("open", warning);
  html.clear();
  if (result.camera) add_screen(result, html);
  if (result.table) add_table(result, html);
  page.html(html);
  write_text_file(path, page.text());
}

}  // namespace frangia
