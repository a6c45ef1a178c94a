#include "frangia/calibrate/board/pose_coverage.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <opencv2/calib3d.hpp>

#include "frangia/core/angles.h"

namespace frangia {
namespace {

constexpr double kWantedField = 0.8;      // of the cells; a board rarely reaches all corners
constexpr double kWantedTilt_deg = 15.0;  // towards each side; the advice is 30
constexpr double kWantedDepth = 0.15;     // farthest over nearest distance, minus 1

struct BoardPose {
  double distance = 0.0;                               ///< of its middle, arbitrary unit
  Eigen::Vector3d normal = -Eigen::Vector3d::UnitZ();  ///< towards the camera
};

/// Focal length of the camera, or that of a field of 40 degrees.
double focal_of(const CameraModel& camera) {
  if (camera.focal_px.allFinite() && camera.focal_px.minCoeff() > 0.0) return camera.focal_px.x();
  return 0.5 * std::max(camera.width_px, camera.height_px) / std::tan(rad_from_deg(20.0));
}

std::optional<BoardPose> homography_pose(const BoardView& view,
                                         const std::vector<Eigen::Vector2d>& points_mm,
                                         const CameraModel& camera) {
  if (view.points.size() < 4) return std::nullopt;
  const double focal = focal_of(camera);
  const Eigen::Vector2d middle(0.5 * (camera.width_px - 1), 0.5 * (camera.height_px - 1));
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& point : points_mm)
    center += point / static_cast<double>(points_mm.size());
  std::vector<cv::Point2d> from;
  std::vector<cv::Point2d> to;
  for (const BoardPoint& point : view.points) {
    const Eigen::Vector2d at = points_mm[static_cast<std::size_t>(point.index)] - center;
    const Eigen::Vector2d seen = (point.camera_px - middle) / focal;
    from.emplace_back(at.x(), at.y());
    to.emplace_back(seen.x(), seen.y());
  }
  const cv::Mat found = cv::findHomography(from, to);
  if (found.empty()) return std::nullopt;
  Eigen::Matrix3d homography;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      homography(row, column) = found.at<double>(row, column);
  }
  const double scale = 2.0 / (homography.col(0).norm() + homography.col(1).norm());
  const Eigen::Vector3d normal = homography.col(0).cross(homography.col(1)).normalized();
  if (!normal.allFinite()) return std::nullopt;
  return BoardPose{std::abs(scale * homography(2, 2)),
                   normal.z() > 0.0 ? Eigen::Vector3d(-normal) : normal};
}

/// The place of a cell, in words.
std::string place_of(std::size_t cell) {
  const auto columns = static_cast<std::size_t>(PoseCoverage::kColumns);
  const std::size_t row = cell / columns;
  const std::size_t column = cell % columns;
  const char* const height = row == 0 ? "upper" : row == 1 ? "middle" : "lower";
  return fmt::format("{} {}", height, column < columns / 2 ? "left" : "right");
}

/// The cell without a board that is farthest from the middle of the image.
std::optional<std::size_t> open_cell(const PoseCoverage& coverage) {
  for (const std::size_t cell : {0U, 3U, 8U, 11U, 1U, 2U, 9U, 10U, 4U, 7U, 5U, 6U})
    if (!coverage.cells.at(cell)) return cell;
  return std::nullopt;
}

PoseAdvice advice(const PoseCoverage& coverage, bool found_last) {
  static constexpr std::array kSides = {"left", "right", "upper", "lower"};
  using Kind = PoseAdvice::Kind;
  if (!found_last) return {Kind::Repeat, {}, {}};
  const auto flattest = static_cast<std::size_t>(
      std::min_element(coverage.tilts_deg.begin(), coverage.tilts_deg.end()) -
      coverage.tilts_deg.begin());
  const std::optional<std::size_t> cell = open_cell(coverage);
  // What is missing most, as a share of what is wanted.
  const double tilt = coverage.tilts_deg.at(flattest) / kWantedTilt_deg;
  const double field = cell ? coverage.field() / kWantedField : 1.0;
  const double depth = (coverage.farthest / coverage.nearest - 1.0) / kWantedDepth;
  if (std::min({tilt, field, depth}) >= 1.0) return {Kind::Sufficient, {}, {}};
  if (field <= tilt && field <= depth) return {Kind::Move, kSides.at(flattest), place_of(*cell)};
  if (tilt <= depth) return {Kind::Tilt, kSides.at(flattest), {}};
  return {coverage.poses % 2 == 0 ? Kind::Nearer : Kind::Farther, {}, {}};
}

}  // namespace

std::string PoseAdvice::text() const {
  std::string tilted = fmt::format("tilt its {} side away from the camera by 30 degrees", side);
  switch (kind) {
    case Kind::Repeat:
      return "the same place again, with the whole board in the image, sharp and evenly lit";
    case Kind::Sufficient:
      return "coverage is sufficient; any other tilt and place adds accuracy";
    case Kind::Move:
      return fmt::format("move the board to the {} of the image, and {}", place, tilted);
    case Kind::Tilt:
      return tilted;
    case Kind::Nearer:
      return "move the board nearer by a tenth of its distance";
    case Kind::Farther:
      return "move the board farther away by a tenth of its distance";
  }
  return {};
}

double PoseCoverage::field() const {
  return static_cast<double>(std::count(cells.begin(), cells.end(), true)) /
         static_cast<double>(cells.size());
}

double PoseCoverage::tilt_deg() const {
  return *std::max_element(tilts_deg.begin(), tilts_deg.end());
}

bool PoseCoverage::sufficient() const {
  return field() >= kWantedField && farthest >= (1.0 + kWantedDepth) * nearest &&
         *std::min_element(tilts_deg.begin(), tilts_deg.end()) >= kWantedTilt_deg;
}

PoseCoverage measure_pose_coverage(std::span<const BoardView> views,
                                   const Board& board,
                                   const CameraModel& camera) {
  const std::vector<Eigen::Vector2d> points_mm = board_points_mm(board);
  PoseCoverage coverage;
  std::vector<double> distances;
  bool found_last = true;
  for (const BoardView& view : views) {
    const std::optional<BoardPose> pose = homography_pose(view, points_mm, camera);
    found_last = pose.has_value();
    if (!pose) continue;
    ++coverage.poses;
    distances.push_back(pose->distance);
    for (const BoardPoint& point : view.points) {
      const auto cell_of = [](double at, int size, int cells) {
        return std::clamp(static_cast<int>((at + 0.5) * cells / size), 0, cells - 1);
      };
      const int column = cell_of(point.camera_px.x(), camera.width_px, PoseCoverage::kColumns);
      const int row = cell_of(point.camera_px.y(), camera.height_px, PoseCoverage::kRows);
      const int cell = row * PoseCoverage::kColumns + column;
      coverage.cells.at(static_cast<std::size_t>(cell)) = true;
    }
    // The board faces the side that lies back: with its left side farther away, x < 0.
    const double x_deg = deg_from_rad(std::asin(std::clamp(pose->normal.x(), -1.0, 1.0)));
    const double y_deg = deg_from_rad(std::asin(std::clamp(pose->normal.y(), -1.0, 1.0)));
    const std::array tilts = {-x_deg, x_deg, -y_deg, y_deg};
    for (std::size_t i = 0; i < tilts.size(); ++i)
      coverage.tilts_deg.at(i) = std::max(coverage.tilts_deg.at(i), tilts.at(i));
  }
  if (!distances.empty()) {
    double mean = 0.0;
    for (const double distance : distances)
      mean += distance / static_cast<double>(distances.size());
    coverage.nearest = *std::min_element(distances.begin(), distances.end()) / mean;
    coverage.farthest = *std::max_element(distances.begin(), distances.end()) / mean;
  }
  coverage.next = advice(coverage, found_last && coverage.poses > 0);
  return coverage;
}

}  // namespace frangia
