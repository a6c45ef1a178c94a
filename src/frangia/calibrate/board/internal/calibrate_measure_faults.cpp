#include "frangia/calibrate/board/internal/calibrate_measure_faults.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "frangia/calibrate/board/board_image.h"
#include "frangia/calibrate/board/find_circles.h"
#include "frangia/calibrate/board/measure_fringe_misfit.h"
#include "frangia/calibrate/board/measure_sharpness.h"
#include "frangia/core/median.h"

namespace frangia {
namespace {

/// Distance of neighboring points along x, px; NaN where there are none.
double step_px(const Board& board, const std::vector<BoardPoint>& points) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i].index == points[i - 1].index + 1 && points[i].index % board.columns != 0)
      steps.push_back((points[i].camera_px - points[i - 1].camera_px).norm());
  }
  return steps.empty() ? std::numeric_limits<double>::quiet_NaN() : median(steps);
}

/// Half the side of a window about a corner that holds no other corner or marker, px.
int corner_reach_px(const Board& board, const std::vector<BoardPoint>& points) {
  const double step = step_px(board, points);
  if (std::isnan(step)) return 2;
  const double free = board.kind == BoardKind::Charuco
                          ? 0.5 * (1.0 - marker_side_mm(board) / board.square_mm)
                          : 0.3;
  constexpr double kForeshortened = 0.7;  // the other side of a tilted square
  return static_cast<int>(std::clamp(kForeshortened * std::min(free, 0.3) * step, 2.0, 20.0));
}

/// Half the side of a window about a point that shows edges of the board, and as few of the next
/// points as may be, px.
int edge_reach_px(const Board& board, const std::vector<BoardPoint>& points) {
  if (board.kind != BoardKind::Circles) return corner_reach_px(board, points);
  const double step = step_px(board, points);
  constexpr double kHalf = 0.5;  // of a circle and the ground about it
  return std::isnan(step) ? 2 : std::max(2, static_cast<int>(std::lround(kHalf * step)));
}

/// Half the side of a window that shows the pattern of the board about a point, px.
int likeness_reach_px(const Board& board, const std::vector<BoardPoint>& points) {
  const double step = step_px(board, points);
  return std::isnan(step) ? 4 : static_cast<int>(std::clamp(0.5 * step, 4.0, 20.0));
}

/// As `measure_motion_px`, of the centers of circles.
double circle_motion_px(const Image<float>& counts,
                        const Board& board,
                        const std::vector<BoardPoint>& points) {
  std::vector<Eigen::Vector2d> centers;
  centers.reserve(points.size());
  for (const BoardPoint& point : points)
    centers.push_back(point.camera_px);
  const std::vector<Eigen::Vector2d> now = find_circles_near(counts, board, centers);
  std::vector<double> x;
  std::vector<double> y;
  for (std::size_t i = 0; i < now.size(); ++i) {
    x.push_back(now[i].x() - centers[i].x());
    y.push_back(now[i].y() - centers[i].y());
  }
  return std::hypot(median(x), median(y));
}

}  // namespace

void calibrate_measure_faults(std::span<const FrameStack> stacks,
                              const Image<float>& image,
                              const Board& board,
                              PoseCapture& pose) {
  const std::vector<BoardPoint>& points = pose.view.points;
  const int reach_px = corner_reach_px(board, points);
  pose.blur_px = measure_blur_px(image, points, edge_reach_px(board, points));
  for (std::size_t i = 0; i < stacks.size(); ++i) {
    const Pattern& pattern = stacks[i].pattern;
    if (pattern.kind != PatternKind::Fringe || stacks[i].exposure != 0) continue;
    const Image<float> mean = board_image(stacks.subspan(i, 1));
    const double motion_px = board.kind == BoardKind::Circles
                                 ? circle_motion_px(mean, board, points)
                                 : measure_motion_px(mean, points, reach_px);
    if (motion_px > pose.motion_px) {
      pose.motion_px = motion_px;
      pose.moved_in = pattern.name;
    }
    const double likeness = measure_likeness(mean, image, points, likeness_reach_px(board, points));
    if (likeness < pose.likeness) {
      pose.likeness = likeness;
      pose.least_like = pattern.name;
    }
    const double misfit = measure_fringe_misfit(stacks[i], points);
    if (misfit > pose.misfit) {
      pose.misfit = misfit;
      pose.misfit_in = pattern.name;
    }
  }
}

}  // namespace frangia
