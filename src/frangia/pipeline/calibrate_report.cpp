// Over 250 lines: a page of HTML, section by section.
#include "frangia/pipeline/calibrate_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/angles.h"
#include "frangia/core/atomic_file.h"
#include "frangia/frames/png.h"

namespace frangia {
namespace {

constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Calibration</title><style>
body{font:15px/1.45 system-ui,sans-serif;margin:2em auto;max-width:1100px;padding:0 1em;color:#222}
table{border-collapse:collapse;margin:.6em 0}td,th{padding:.2em .8em;border-bottom:1px solid #ddd;text-align:right}
td:first-child,th:first-child{text-align:left}.bad{color:#b00020;font-weight:600}
.row{display:flex;flex-wrap:wrap;gap:1.2em}figure{margin:0}figcaption{font-size:13px;color:#555}
svg{background:#f6f6f6;border:1px solid #ccc}.warning{background:#fff4e0;border-left:4px solid #e09000;padding:.4em .8em}
</style></head><body>
)";

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '&') {
      out += "&amp;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += c;
    }
  }
  return out;
}

std::string base64_of(const std::vector<char>& bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t block = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t byte =
          i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U;
      block = block << 8U | byte;
    }
    for (std::size_t k = 0; k < 4; ++k)
      out += i + k <= bytes.size() ? kDigits[block >> (18U - 6U * k) & 63U] : '=';
  }
  return out;
}

/// Color of an error relative to a large one: green, yellow, red.
std::string color_of(double share) {
  const double hue = 120.0 * (1.0 - std::clamp(share, 0.0, 1.0));
  return fmt::format("hsl({:.0f},85%,40%)", hue);
}

double sigma_named(const RigSolution& solution, const std::string& name) {
  for (std::size_t i = 0; i < solution.parameters.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    if (solution.parameters[i] == name) return std::sqrt(solution.covariance(row, row));
  }
  return 0.0;
}

void add_device(const char* name,
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

void add_summary(const RigCalibration& result, const Board& board, std::string& html) {
  const RigSolution& solution = result.solution;
  html += fmt::format(
      "<h1>Calibration</h1><p>{} poses of a {} of {} × {} points, {:g} mm apart{}.</p>\n"
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
  add_device("camera", "camera", solution.camera, solution.camera_residuals, solution, html);
  add_device(
      "projector", "projector", solution.projector, solution.projector_residuals, solution, html);
  const Eigen::Vector3d baseline = solution.projector_from_camera.translation();
  html += fmt::format(
      "</table><p>Baseline {:.2f} mm; the axes are turned by {:.2f}°.</p>\n"
      "<p>Estimated beyond one focal length, principal point and k1: {}.<br>Held, because the "
      "poses "
      "do not support them: {}.</p>\n",
      baseline.norm(),
      deg_from_rad(Eigen::AngleAxisd(solution.projector_from_camera.linear()).angle()),
      solution.terms.empty() ? "nothing" : fmt::format("{}", fmt::join(solution.terms, ", ")),
      solution.held.empty() ? "nothing" : fmt::format("{}", fmt::join(solution.held, ", ")));
}

void add_poses(const RigCalibration& result, std::string& html) {
  const RigSolution& solution = result.solution;
  html +=
      "<h2>Poses</h2><table><tr><th>view</th><th>camera RMS, px</th><th>projector RMS, px</th>"
      "<th>distance, mm</th><th>tilt, °</th><th>change when left out, mm</th></tr>\n";
  for (std::size_t i = 0; i < result.views.size(); ++i) {
    const Eigen::Isometry3d& pose = solution.camera_from_board[i];
    const double tilt_rad =
        std::acos(std::min(1.0, std::abs(pose.linear().col(2).dot(Eigen::Vector3d::UnitZ()))));
    const auto cell = [](double value, double typical) {
      return fmt::format("<td{}>{:.3f}</td>", value > 3.0 * typical ? " class=\"bad\"" : "", value);
    };
    html +=
        fmt::format("<tr><td>{}</td>{}{}<td>{:.0f}</td><td>{:.0f}</td><td>{:.4f}</td></tr>\n",
                    escaped(result.views[i].name),
                    cell(solution.camera_by_view[i].rms_px, solution.camera_residuals.rms_px),
                    cell(solution.projector_by_view[i].rms_px, solution.projector_residuals.rms_px),
                    pose.translation().norm(),
                    deg_from_rad(tilt_rad),
                    i < solution.leave_one_out_mm.size() ? solution.leave_one_out_mm[i] : 0.0);
  }
  html += "</table>\n";
}

/// Arrows of all residuals over the image of one device.
void add_residual_map(const char* title,
                      const RigCalibration& result,
                      bool by_projector,
                      const CameraModel& model,
                      const ResidualSummary& summary,
                      std::string& html) {
  constexpr double kArrow = 0.03;  // of the width: length of an arrow of the RMS
  const double scale = kArrow * model.width_px / std::max(summary.rms_px, 1e-6);
  html +=
      fmt::format("<figure><svg viewBox=\"0 0 {0} {1}\" width=\"520\" stroke-width=\"{2:.1f}\">\n",
                  model.width_px,
                  model.height_px,
                  model.width_px / 500.0);
  const auto& residuals =
      by_projector ? result.solution.projector_residuals_px : result.solution.camera_residuals_px;
  for (std::size_t view = 0; view < result.views.size(); ++view) {
    for (std::size_t i = 0; i < result.views[view].points.size(); ++i) {
      const BoardPoint& point = result.views[view].points[i];
      const Eigen::Vector2d& from = by_projector ? point.projector_px : point.camera_px;
      const Eigen::Vector2d& residual = residuals[view][i];
      if (!from.allFinite() || !residual.allFinite()) continue;
      const Eigen::Vector2d to = from + scale * residual;
      html += fmt::format(
          "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"/>\n",
          from.x(),
          from.y(),
          to.x(),
          to.y(),
          color_of(residual.norm() / (3.0 * summary.rms_px)));
    }
  }
  html += fmt::format(
      "</svg><figcaption>{}: residuals of all points, enlarged {:.0f} times. Red is three times "
      "the RMS of {:.3f} px or more. Arrows of neighbors that agree are a fault of the model; a "
      "random pattern is noise.</figcaption></figure>\n",
      title,
      scale,
      summary.rms_px);
}

/// Share of the cells of a grid over the image that hold a point.
double coverage_of(const RigCalibration& result, const CameraModel& model) {
  constexpr int kColumns = 8;
  constexpr int kRows = 6;
  std::array<bool, kColumns * kRows> seen{};
  for (const BoardView& view : result.views) {
    for (const BoardPoint& point : view.points) {
      const int column = std::clamp(
          static_cast<int>(point.camera_px.x() / model.width_px * kColumns), 0, kColumns - 1);
      const int row =
          std::clamp(static_cast<int>(point.camera_px.y() / model.height_px * kRows), 0, kRows - 1);
      seen.at(static_cast<std::size_t>(row * kColumns + column)) = true;
    }
  }
  return static_cast<double>(std::count(seen.begin(), seen.end(), true)) / (kColumns * kRows);
}

/// Outlines of the boards in the camera image.
void add_coverage(const RigCalibration& result, const Board& board, std::string& html) {
  const RigSolution& solution = result.solution;
  const CameraModel& model = solution.camera;
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
  const double large_px = 3.0 * std::max(result.solution.camera_residuals.rms_px, 1e-6);
  for (std::size_t view = 0; view < result.views.size(); ++view) {
    if (view >= result.pictures.size() || result.pictures[view].pixels.width() == 0) continue;
    const BoardPicture& picture = result.pictures[view];
    const int width = picture.pixels.width();
    const int height = picture.pixels.height();
    html += fmt::format(
        "<figure><svg viewBox=\"0 0 {0} {1}\" width=\"340\"><image width=\"{0}\" height=\"{1}\" "
        "href=\"data:image/png;base64,{2}\"/>\n",
        width,
        height,
        base64_of(encode_png(picture.pixels)));
    for (std::size_t i = 0; i < result.views[view].points.size(); ++i) {
      const Eigen::Vector2d pixel =
          (result.views[view].points[i].camera_px.array() + 0.5) / picture.px_per_px;
      const double error_px = result.solution.camera_residuals_px[view][i].norm();
      html +=
          fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"none\" stroke=\"{}\"/>\n",
                      pixel.x(),
                      pixel.y(),
                      color_of(error_px / large_px));
    }
    html += fmt::format("</svg><figcaption>{}</figcaption></figure>\n",
                        escaped(result.views[view].name));
  }
  html += "</div>\n";
}

}  // namespace

void write_calibration_report(const std::filesystem::path& path,
                              const RigCalibration& result,
                              const Board& board,
                              std::span<const std::string> warnings) {
  std::string html = kHead;
  add_summary(result, board, html);
  for (const std::string& warning : warnings)
    html += fmt::format("<p class=\"warning\">{}</p>\n", escaped(warning));
  add_poses(result, html);
  const RigSolution& solution = result.solution;
  html += "<h2>Residuals and coverage</h2><div class=\"row\">\n";
  add_residual_map("Camera", result, false, solution.camera, solution.camera_residuals, html);
  add_residual_map(
      "Projector", result, true, solution.projector, solution.projector_residuals, html);
  add_coverage(result, board, html);
  html += "</div>\n";
  add_boards(result, html);
  html += "</body></html>\n";
  AtomicFile file(path);
  file.stream().write(html.data(), static_cast<std::streamsize>(html.size()));
  file.commit();
}

}  // namespace frangia
