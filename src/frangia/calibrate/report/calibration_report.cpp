#include "frangia/calibrate/report/calibration_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/calibrate/report/internal/residual_figure.h"
#include "frangia/calibrate/report/residual_maps.h"
#include "frangia/core/angles.h"
#include "frangia/core/durable_file.h"
#include "frangia/core/text.h"
#include "frangia/frames/png.h"
#include "frangia/page/html_page.h"

namespace frangia {
namespace {

double sigma_named(const RigSolution& solution, const std::string& name) {
  for (std::size_t i = 0; i < solution.parameters.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    if (solution.parameters[i] == name) return std::sqrt(solution.covariance(row, row));
  }
  return 0.0;
}

void add_device(const std::string& name,
                const std::string& prefix,
                const CameraModel& model,
                const ResidualSummary& residuals,
                const RigSolution& solution,
                std::string& html) {
  html += fmt::format(
      "<tr><td>{}</td><td>{:.3f}</td><td>{:.2f}</td><td>{}</td><td>{:.2f} ± {:.2f}</td>"
      "<td>{:.2f} ± {:.2f}</td><td>{:.2f} ± {:.2f}</td><td>{:.4f}</td></tr>\n",
      name,
      residuals.rms_px,
      residuals.max_px,
      residuals.points,
      model.focal_px.x(),
      sigma_named(solution, prefix + ".focal_px"),
      model.principal_point_px.x(),
      sigma_named(solution, prefix + ".principal_x_px"),
      model.principal_point_px.y(),
      sigma_named(solution, prefix + ".principal_y_px"),
      model.distortion[0]);
}

/// How a device stands to the reference camera.
std::string place_of(const std::string& device, const Eigen::Isometry3d& from_camera) {
  return fmt::format("<p>{} is {:.2f} mm from the camera; their axes are turned by {:.2f}°.</p>\n",
                     device,
                     from_camera.translation().norm(),
                     deg_from_rad(Eigen::AngleAxisd(from_camera.linear()).angle()));
}

void add_summary(const RigCalibration& result, const Board& board, std::string& html) {
  const RigSolution& solution = result.solution;
  html += fmt::format(
      "<p>{} poses of a {} of {} × {} points, {:g} mm apart{}.</p>\n"
      "<p>Grade: <b>{}</b>. The calibration adds {:.3f} mm to the uncertainty of a point at {:.0f} "
      "mm, as its covariance predicts, and {:.3f} mm, as the differences between the poses "
      "show.</p>\n",
      result.views.size(),
      name_of(board.kind),
      board.columns,
      board.rows,
      board.square_mm,
      result.rig.calibration ? ", " + result.rig.calibration->date : "",
      calibration_grade(solution),
      solution.point_sigma_mm,
      solution.distance_mm,
      solution.spread_mm);
  html +=
      "<table><tr><th></th><th>RMS, px</th><th>largest, px</th><th>points</th><th>focal length, px"
      "</th><th>principal point x</th><th>y, px</th><th>k1</th></tr>\n";
  const SolvedCamera& reference = solution.reference();
  add_device("camera", "camera", reference.model, reference.residuals, solution, html);
  if (solution.has_projector) {
    add_device("projector",
               "projector",
               solution.projector,
               reference.projector_residuals,
               solution,
               html);
  }
  for (const SolvedCamera& camera : std::span(solution.cameras).subspan(1)) {
    add_device(html_escaped("camera \"" + camera.name + "\""),
               "camera-" + camera.name,
               camera.model,
               camera.residuals,
               solution,
               html);
  }
  html += "</table>\n";
  if (solution.has_projector) html += place_of("The projector", solution.projector_from_camera);
  for (const SolvedCamera& camera : std::span(solution.cameras).subspan(1))
    html += place_of(html_escaped("Camera \"" + camera.name + "\""), camera.camera_from_rig);
  html += fmt::format(
      "<p>Estimated beyond one focal length, principal point and k1: {}.<br>Held, because the "
      "poses "
      "do not support them: {}.</p>\n",
      solution.terms.empty() ? "nothing" : fmt::format("{}", fmt::join(solution.terms, ", ")),
      solution.held.empty() ? "nothing" : fmt::format("{}", fmt::join(solution.held, ", ")));
}

/// A column of the table of poses: the residuals of one device.
struct PoseColumn {
  std::string title;
  const std::vector<ResidualSummary>* by_view = nullptr;
  double typical_px = 0.0;
};

std::vector<PoseColumn> pose_columns(const RigSolution& solution) {
  const SolvedCamera& reference = solution.reference();
  std::vector<PoseColumn> columns{{"camera", &reference.by_view, reference.residuals.rms_px}};
  if (solution.has_projector) {
    columns.push_back(
        {"projector", &reference.projector_by_view, reference.projector_residuals.rms_px});
  }
  for (const SolvedCamera& camera : std::span(solution.cameras).subspan(1))
    columns.push_back({html_escaped(camera.name), &camera.by_view, camera.residuals.rms_px});
  return columns;
}

void add_poses(const RigCalibration& result, std::string& html) {
  const RigSolution& solution = result.solution;
  const std::vector<PoseColumn> columns = pose_columns(solution);
  html += "<h2>Poses</h2><table><tr><th>view</th>";
  for (const PoseColumn& column : columns)
    html += fmt::format("<th>{} RMS, px</th>", column.title);
  html += "<th>distance, mm</th><th>tilt, °</th><th>change when left out, mm</th></tr>\n";
  for (std::size_t i = 0; i < result.views.size(); ++i) {
    const Eigen::Isometry3d& pose = solution.camera_from_board[i];
    const double tilt_rad =
        std::acos(std::min(1.0, std::abs(pose.linear().col(2).dot(Eigen::Vector3d::UnitZ()))));
    html += fmt::format("<tr><td>{}</td>", html_escaped(result.views[i].name));
    for (const PoseColumn& column : columns) {
      const double rms_px = (*column.by_view)[i].rms_px;
      const bool bad = rms_px > 3.0 * column.typical_px;
      html += fmt::format("<td{}>{:.3f}</td>", bad ? " class=\"bad\"" : "", rms_px);
    }
    html += fmt::format("<td>{:.0f}</td><td>{:.0f}</td><td>{:.4f}</td></tr>\n",
                        pose.translation().norm(),
                        deg_from_rad(tilt_rad),
                        i < solution.leave_one_out_mm.size() ? solution.leave_one_out_mm[i] : 0.0);
  }
  html += "</table>\n";
}

/// Share of the cells of a grid over the image that hold a point.
double coverage_of(const RigCalibration& result, const CameraModel& model) {
  constexpr std::size_t kColumns = 8;
  constexpr std::size_t kRows = 6;
  std::array<bool, kColumns * kRows> seen{};
  const auto cell = [](double share, std::size_t cells) {
    const double place = share * static_cast<double>(cells);
    return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(cells - 1)));
  };
  for (const BoardView& view : result.views) {
    for (const BoardPoint& point : view.points) {
      const std::size_t column = cell(point.camera_px.x() / model.width_px, kColumns);
      const std::size_t row = cell(point.camera_px.y() / model.height_px, kRows);
      seen.at(row * kColumns + column) = true;
    }
  }
  return static_cast<double>(std::count(seen.begin(), seen.end(), true)) / seen.size();
}

/// Outlines of the boards in the camera image.
void add_coverage(const RigCalibration& result, const Board& board, std::string& html) {
  const RigSolution& solution = result.solution;
  const CameraModel& model = solution.reference().model;
  html += fmt::format(
      "<figure><svg viewBox=\"0 0 {} {}\" width=\"520\" stroke-width=\"{:.1f}\" "
      "fill-opacity=\"0.12\">\n",
      model.width_px,
      model.height_px,
      model.width_px / 300.0);
  const double half_x = 0.5 * (board.columns - 1) * board.square_mm;
  const double half_y = 0.5 * (board.rows - 1) * board.square_mm;
  for (std::size_t view = 0; view < result.views.size(); ++view) {
    html += "<polygon points=\"";
    for (const auto& [x, y] : {std::pair{-half_x, -half_y},
                               std::pair{half_x, -half_y},
                               std::pair{half_x, half_y},
                               std::pair{-half_x, half_y}}) {
      const Eigen::Vector2d pixel =
          model.project(solution.camera_from_board[view] * Eigen::Vector3d(x, y, 0.0));
      html += fmt::format("{:.1f},{:.1f} ", pixel.x(), pixel.y());
    }
    const double hue = 360.0 * static_cast<double>(view) / static_cast<double>(result.views.size());
    html +=
        fmt::format("\" fill=\"hsl({0:.0f},70%,45%)\" stroke=\"hsl({0:.0f},70%,40%)\"/>\n", hue);
  }
  html += fmt::format(
      "</svg><figcaption>Coverage: the boards in the camera image. Points lie in {:.0f} % of an 8 "
      "× "
      "6 grid; distortion is extrapolated elsewhere.</figcaption></figure>\n",
      100.0 * coverage_of(result, model));
}

/// Pictures of the boards with their points.
void add_boards(const RigCalibration& result, std::string& html) {
  html += "<h2>Boards as found</h2><div class=\"row\">\n";
  const double large_px = 3.0 * std::max(result.solution.reference().residuals.rms_px, 1e-6);
  for (std::size_t view = 0; view < result.views.size(); ++view) {
    if (view >= result.pictures.size() || result.pictures[view].pixels.width() == 0) continue;
    const BoardPicture& picture = result.pictures[view];
    const int width = picture.pixels.width();
    const int height = picture.pixels.height();
    html += fmt::format(
        "<figure><svg viewBox=\"0 0 {0} {1}\" width=\"340\"><image width=\"{0}\" height=\"{1}\" "
        "href=\"{2}\"/>\n",
        width,
        height,
        data_uri("image/png", encode_png(picture.pixels)));
    for (std::size_t i = 0; i < result.views[view].points.size(); ++i) {
      const Eigen::Vector2d pixel =
          (result.views[view].points[i].camera_px.array() + 0.5) / picture.px_per_px;
      const double error_px = result.solution.reference().residuals_px[view][i].norm();
      html +=
          fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"none\" stroke=\"{}\"/>\n",
                      pixel.x(),
                      pixel.y(),
                      color_of(error_px / large_px));
    }
    html += fmt::format("</svg><figcaption>{}</figcaption></figure>\n",
                        html_escaped(result.views[view].name));
  }
  html += "</div>\n";
}

}  // namespace

void write_calibration_report(const std::filesystem::path& path,
                              const RigCalibration& result,
                              const Board& board,
                              std::span<const std::string> warnings) {
  HtmlPage page("Calibration");
  std::string html;
  add_summary(result, board, html);
  page.html(html);
  for (const std::string& warning : warnings)
    page.verdict("open", warning);
  html.clear();
  add_poses(result, html);
  html += "<h2>Residuals and coverage</h2><div class=\"row\">\n";
  for (const ResidualMap& map : residual_maps(result))
    html += residual_figure(map);
  add_coverage(result, board, html);
  html += "</div>\n";
  add_boards(result, html);
  page.html(html);
  write_text_file(path, page.text());
}

}  // namespace frangia
