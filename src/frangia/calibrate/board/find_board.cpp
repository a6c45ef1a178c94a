#include "frangia/calibrate/board/find_board.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/LU>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "frangia/calibrate/board/find_charuco.h"
#include "frangia/calibrate/board/internal/opencv_image.h"
#include "frangia/calibrate/board/internal/read_markers.h"
#include "frangia/core/error.h"
#include "frangia/core/linear_algebra.h"

namespace frangia {

std::vector<BoardPoint> find_board(const Image<float>& counts, const Board& board) {
  check_board(board);
  if (board.kind == BoardKind::Charuco) return find_charuco(counts, board).points;
  const auto pixels = board.kind == BoardKind::Circles ? find_circles(counts, board)
                                                       : find_checkerboard(counts, board);
  std::vector<BoardPoint> points;
  if (!pixels) return points;
  for (std::size_t i = 0; i < pixels->size(); ++i) {
    BoardPoint point;
    point.index = static_cast<int>(i);
    point.camera_px = (*pixels)[i];
    points.push_back(point);
  }
  return points;
}

namespace {

/// Shortest distance between a corner and its neighbors in row and column.
double spacing_px(const std::vector<cv::Point2f>& corners, int columns) {
  double least = std::numeric_limits<double>::infinity();
  const auto step = static_cast<std::size_t>(columns);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i % step + 1 < step) least = std::min(least, cv::norm(corners[i + 1] - corners[i]));
    if (i + step < corners.size())
      least = std::min(least, cv::norm(corners[i + step] - corners[i]));
  }
  return least;
}

/// Corners to a pixel or better. Which treatment of the image succeeds depends on it: a board in
/// the dark is found without equalization, one in shadow with it.
std::optional<std::vector<cv::Point2f>> search(const cv::Mat& linear, const cv::Size& size) {
  struct Treatment {
    cv::Mat bytes;
    int flags;
  };
  const cv::Mat local = equalized(linear);
  const std::array<Treatment, 3> treatments{{{display_bytes(linear), cv::CALIB_CB_NORMALIZE_IMAGE},
                                             {local, 0},
                                             {local, cv::CALIB_CB_NORMALIZE_IMAGE}}};
  constexpr std::array kScales = {0.5, 1.0, 0.7, 0.35};
  for (const double scale : kScales) {
    for (const Treatment& treatment : treatments) {
      cv::Mat scaled;
      cv::resize(treatment.bytes, scaled, {}, scale, scale, cv::INTER_AREA);
      std::vector<cv::Point2f> corners;
      if (!cv::findChessboardCornersSB(scaled, size, corners, treatment.flags)) continue;
      for (cv::Point2f& corner : corners) {
        corner.x = static_cast<float>((corner.x + 0.5) / scale - 0.5);
        corner.y = static_cast<float>((corner.y + 0.5) / scale - 0.5);
      }
      return corners;
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::vector<Eigen::Vector2d>> find_checkerboard(const Image<float>& counts,
                                                              const Board& board) {
  check_board(board);
  const cv::Mat linear = opencv_view(counts);
  auto corners = search(linear, cv::Size(board.columns, board.rows));
  if (!corners) return std::nullopt;
  // A window that reaches almost to the next edges, where the gradients of others begin.
  constexpr double kReach = 0.3;
  const int reach =
      static_cast<int>(std::clamp(kReach * spacing_px(*corners, board.columns), 2.0, 20.0));
  cv::Mat smooth;
  cv::GaussianBlur(linear, smooth, {}, 1.0);
  cv::cornerSubPix(smooth,
                   *corners,
                   cv::Size(reach, reach),
                   cv::Size(-1, -1),
                   cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-5));
  std::vector<Eigen::Vector2d> found;
  for (const cv::Point2f& corner : *corners) {
    const cv::Point2f place = refine_corner(linear, corner, reach);
    found.emplace_back(place.x, place.y);
  }
  return found;
}

namespace {

/// Refines the center of the ellipse that a dark circle on a bright ground shows. `along` and
/// `across` are the steps to the next circles; the ground half way to them belongs to the circle.
/// It stays where it is when it would move by more than a tenth of a step.
///
/// @units    pixels, (0, 0) at the center of the top-left one
/// @source   Ouellet & Hebert 2009, Precise ellipse estimation without contour point extraction:
///           the dual conic to which the gradient lines of all pixels are tangent
cv::Point2f refine_circle(const cv::Mat& counts,
                          const cv::Point2f& center,
                          const cv::Point2f& along,
                          const cv::Point2f& across) {
  Eigen::Matrix2d steps;
  steps << along.x, across.x, along.y, across.y;
  if (!(std::abs(steps.determinant()) > 1.0)) return center;
  const Eigen::Matrix2d circles_by_px = steps.inverse();
  constexpr double kReach = 0.5;  // steps
  const auto reach = [](float a, float b) {
    return static_cast<int>(kReach * std::hypot(a, b)) + 4;  // and the gradients' margin
  };
  const EvenedWindow window =
      even_light(counts, cv::Point(center), {reach(along.x, across.x), reach(along.y, across.y)});
  if (window.counts.empty()) return center;
  cv::Mat smooth;
  cv::Mat down;
  cv::Mat right;
  cv::GaussianBlur(window.counts, smooth, {}, 1.0);
  cv::Scharr(smooth, right, CV_32F, 1, 0);
  cv::Scharr(smooth, down, CV_32F, 0, 1);
  double steepest = 0.0;
  cv::minMaxLoc(cv::abs(right) + cv::abs(down), nullptr, &steepest);
  if (!(steepest > 0.0)) return center;
  const double size_px = kReach * steps.norm();
  const Eigen::Vector2d middle(static_cast<double>(center.x) - window.origin.x,
                               static_cast<double>(center.y) - window.origin.y);
  using Coefficients = Eigen::Matrix<double, 5, 1>;
  Eigen::Matrix<double, 5, 5> normal = Eigen::Matrix<double, 5, 5>::Zero();
  Coefficients target = Coefficients::Zero();
  for (int y = 1; y + 1 < window.counts.rows; ++y) {
    for (int x = 1; x + 1 < window.counts.cols; ++x) {
      const Eigen::Vector2d from_middle = Eigen::Vector2d(x, y) - middle;
      if ((circles_by_px * from_middle).norm() > kReach) continue;
      const Eigen::Vector2d gradient =
          Eigen::Vector2d(right.at<float>(y, x), down.at<float>(y, x)) / steepest;
      const double line = -gradient.dot(from_middle) / size_px;
      Coefficients terms;
      terms << gradient.x() * gradient.x(), gradient.x() * gradient.y(),
          gradient.y() * gradient.y(), gradient.x() * line, gradient.y() * line;
      normal += terms * terms.transpose();
      target -= line * line * terms;
    }
  }
  const Coefficients conic = solve_symmetric(normal, target);
  const Eigen::Vector2d shift = 0.5 * size_px * conic.tail<2>();
  constexpr double kFarthest = 0.1;  // steps
  if (!((circles_by_px * shift).norm() < kFarthest)) return center;
  return center + cv::Point2f(static_cast<float>(shift.x()), static_cast<float>(shift.y()));
}

/// The step from a circle to the next one, in columns or rows: the mean of those to both sides.
cv::Point2f step_at(
    const std::vector<cv::Point2f>& centers, int index, int stride, int place, int count) {
  const int before = place > 0 ? index - stride : index;
  const int after = place + 1 < count ? index + stride : index;
  const auto at = [&](int i) { return centers[static_cast<std::size_t>(i)]; };
  return (at(after) - at(before)) / std::max(1, (after - before) / stride);
}

}  // namespace

std::optional<std::vector<Eigen::Vector2d>> find_circles(const Image<float>& counts,
                                                         const Board& board) {
  check_board(board);
  const cv::Mat bytes = display_bytes(opencv_view(counts));
  cv::SimpleBlobDetector::Params blobs;
  // A circle spans at least eight pixels and at most a quarter of the image.
  constexpr float kLeastArea = 50.0F;
  blobs.minArea = kLeastArea;
  blobs.maxArea = static_cast<float>(bytes.total()) / 16.0F;
  blobs.minDistBetweenBlobs = 4.0F;
  std::vector<cv::Point2f> centers;
  const cv::Size size(board.columns, board.rows);
  const bool found = cv::findCirclesGrid(bytes,
                                         size,
                                         centers,
                                         cv::CALIB_CB_SYMMETRIC_GRID | cv::CALIB_CB_CLUSTERING,
                                         cv::SimpleBlobDetector::create(blobs));
  if (!found) return std::nullopt;
  std::vector<Eigen::Vector2d> near;
  near.reserve(centers.size());
  for (const cv::Point2f& center : centers)
    near.emplace_back(center.x, center.y);
  return find_circles_near(counts, board, near);
}

std::vector<Eigen::Vector2d> find_circles_near(const Image<float>& counts,
                                               const Board& board,
                                               std::span<const Eigen::Vector2d> centers_px) {
  std::vector<cv::Point2f> centers;
  centers.reserve(centers_px.size());
  for (const Eigen::Vector2d& center : centers_px)
    centers.emplace_back(static_cast<float>(center.x()), static_cast<float>(center.y()));
  std::vector<Eigen::Vector2d> out;
  const cv::Mat linear = opencv_view(counts);
  for (int i = 0; i < board.columns * board.rows; ++i) {
    const cv::Point2f center =
        refine_circle(linear,
                      centers[static_cast<std::size_t>(i)],
                      step_at(centers, i, 1, i % board.columns, board.columns),
                      step_at(centers, i, board.columns, i / board.columns, board.rows));
    out.emplace_back(center.x, center.y);
  }
  return out;
}

std::vector<FoundMarker> find_markers(const Image<float>& counts, const std::string& dictionary) {
  const auto known = find_aruco_dictionary(dictionary);
  require(known.has_value(), "find_markers: the dictionary does not exist");
  std::vector<FoundMarker> found;
  for (const SeenMarker& marker : read_all_markers(display_bytes(opencv_view(counts)), *known)) {
    FoundMarker& one = found.emplace_back();
    one.code = marker.id;
    for (std::size_t i = 0; i < 4; ++i)
      one.corners_px.at(i) = {static_cast<double>(marker.corners.at(i).x),
                              static_cast<double>(marker.corners.at(i).y)};
  }
  return found;
}

std::optional<std::array<int, 2>> count_corners(const Image<float>& counts) {
  const cv::Mat linear = opencv_view(counts);
  const std::array pictures = {display_bytes(linear), equalized(linear)};
  constexpr std::array kScales = {0.35, 0.5, 0.7, 1.0};
  // A grid grows from its first corners and may stop early or take in the board's edge, differently
  // at each scale: the size that is found most often counts, of equals the larger.
  std::map<std::array<int, 2>, int> found;
  for (const double scale : kScales) {
    for (const cv::Mat& bytes : pictures) {
      cv::Mat scaled;
      cv::resize(bytes, scaled, {}, scale, scale, cv::INTER_AREA);
      std::vector<cv::Point2f> corners;
      cv::Mat grid;
      constexpr int kFlags =
          cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_EXHAUSTIVE | cv::CALIB_CB_LARGER;
      constexpr int kLeast = 3;
      // A grid of the least size is found in noise, too.
      if (cv::findChessboardCornersSB(scaled, cv::Size(kLeast, kLeast), corners, kFlags, grid) &&
          std::max(grid.cols, grid.rows) > kLeast)
        ++found[{std::max(grid.cols, grid.rows), std::min(grid.cols, grid.rows)}];
    }
  }
  const auto best = std::max_element(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return std::pair(a.second, a.first[0] * a.first[1]) <
           std::pair(b.second, b.first[0] * b.first[1]);
  });
  if (best == found.end()) return std::nullopt;
  return best->first;
}

}  // namespace frangia
