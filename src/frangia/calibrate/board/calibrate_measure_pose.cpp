#include "frangia/calibrate/board/calibrate_measure_pose.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include "frangia/calibrate/board/board_image.h"
#include "frangia/calibrate/board/find_board.h"
#include "frangia/calibrate/board/find_charuco.h"
#include "frangia/calibrate/board/fit_phase_at.h"
#include "frangia/calibrate/board/measure_sharpness.h"
#include "frangia/core/angles.h"
#include "frangia/core/image.h"
#include "frangia/core/statistics.h"

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

/// Measures what faults of a capture show, at the points of `pose`: blur, motion between patterns,
/// patterns that belong to another pose, and frames that do not follow their shifts. `image` is the
/// one in which the points were found.
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

/// The stacks whose fringes run in one direction.
std::vector<FrameStack> stacks_of(std::span<const FrameStack> stacks, FringeDirection direction) {
  std::vector<FrameStack> chosen;
  std::copy_if(stacks.begin(), stacks.end(), std::back_inserter(chosen), [&](const auto& stack) {
    const PatternKind kind = stack.pattern.kind;
    return (kind == PatternKind::Fringe || kind == PatternKind::Gray) &&
           stack.pattern.direction == direction;
  });
  return chosen;
}

/// Sets one projector coordinate of all points from the phase of its direction.
void add_projector_pixels(std::span<const FrameStack> stacks,
                          FringeDirection direction,
                          const Rig& known,
                          const PoseOptions& options,
                          const Run& run,
                          std::vector<BoardPoint>& points) {
  DecodeOptions decode = options.decode;
  decode.keep_maps = false;
  decode.order_jumps.max_share = 0.0;  // a board is flat: jumps show frames that do not fit
  decode.fill.max_px = 0;              // a point is fitted to measured pixels only
  // The rays serve the decoding of scans without absolute phase only.
  const DecodedDirection decoded =
      decode_view(stacks_of(stacks, direction), known, {}, decode, run).directions.front();
  const AbsolutePhase& absolute = decoded.phase;
  const double px_per_rad = absolute.pattern.period_px / kTwoPi;
  const int axis = direction == FringeDirection::Vertical ? 0 : 1;
  // Pixels of a Gray code share the borders of their stripes: what the code counts as systematic is
  // an error of the point.
  const bool is_code = !decoded.check && !absolute.systematic_rad.empty();
  const auto shared_of = [&](const BoardPoint& point) {
    if (!is_code) return 0.0;
    const Image<float>& shared = absolute.systematic_rad;
    const int x =
        std::clamp(static_cast<int>(std::lround(point.camera_px.x())), 0, shared.width() - 1);
    const int y =
        std::clamp(static_cast<int>(std::lround(point.camera_px.y())), 0, shared.height() - 1);
    return std::isnan(shared(x, y)) ? 0.0 : static_cast<double>(shared(x, y));
  };
  for (BoardPoint& point : points) {
    const PhaseAt phase =
        fit_phase_at(absolute.phase_rad, absolute.sigma_rad, point.camera_px, options.fit);
    point.projector_px[axis] = px_per_rad * phase.phase_rad;
    point.projector_sigma_px[axis] = px_per_rad * std::hypot(phase.sigma_rad, shared_of(point));
    point.projector_by_camera.row(axis) = px_per_rad * phase.gradient_rad_per_px.transpose();
  }
}

/// Part of the image that a pose's brightness is measured on: the box about the points, or all.
struct ImageBox {
  int left = 0, top = 0, right = 0, bottom = 0;
};

ImageBox box_about(const std::vector<BoardPoint>& points, int width, int height) {
  if (points.empty()) return {0, 0, width, height};
  Eigen::AlignedBox2d box;
  for (const BoardPoint& point : points)
    box.extend(point.camera_px);
  const auto within = [](double value, int size) {
    return std::clamp(static_cast<int>(std::lround(value)), 0, size);
  };
  return {within(box.min().x(), width),
          within(box.min().y(), height),
          within(box.max().x(), width),
          within(box.max().y(), height)};
}

void measure_light(std::span<const FrameStack> stacks,
                   const Image<float>& image,
                   int white_level,
                   PoseCapture& pose) {
  const ImageBox box = box_about(pose.view.points, image.width(), image.height());
  std::vector<float> counts;
  std::size_t saturated = 0;
  constexpr int kStride = 3;  // every ninth pixel is enough for a share
  for (int y = box.top; y < box.bottom; y += kStride) {
    for (int x = box.left; x < box.right; x += kStride) {
      counts.push_back(image(x, y));
      const bool full = std::any_of(stacks.begin(), stacks.end(), [&](const FrameStack& stack) {
        const PatternKind kind = stack.pattern.kind;
        return (kind == PatternKind::Fringe || kind == PatternKind::Gray) && stack.exposure == 0 &&
               std::any_of(stack.frames.begin(), stack.frames.end(), [&](const Frame& frame) {
                 return counts_at(frame, x, y) >= stack.white_level;
               });
      });
      if (full) ++saturated;
    }
  }
  if (counts.empty()) return;
  constexpr double kBright = 0.95;
  const auto rank =
      counts.begin() + static_cast<std::ptrdiff_t>(kBright * static_cast<double>(counts.size()));
  std::nth_element(counts.begin(), rank, counts.end());
  pose.brightness = static_cast<double>(*rank) / white_level;
  pose.saturated = static_cast<double>(saturated) / static_cast<double>(counts.size());
}

/// The image reduced by averaging whole blocks of pixels to at most 480 columns.
BoardPicture picture_of(const Image<float>& image) {
  constexpr int kColumns = 480;
  const int step = std::max(1, (image.width() + kColumns - 1) / kColumns);
  BoardPicture picture{Image<std::uint8_t>(image.width() / step, image.height() / step),
                       static_cast<double>(step)};
  const auto counts = image.pixels();
  const float brightest = std::max(1.0F, *std::max_element(counts.begin(), counts.end()));
  for (int y = 0; y < picture.pixels.height(); ++y) {
    for (int x = 0; x < picture.pixels.width(); ++x) {
      float sum = 0.0F;
      for (int v = 0; v < step; ++v) {
        for (int u = 0; u < step; ++u)
          sum += std::max(0.0F, image(x * step + u, y * step + v));
      }
      constexpr float kGamma = 0.6F;  // of a display, so that the dark squares are visible
      const float level = std::pow(sum / static_cast<float>(step * step) / brightest, kGamma);
      picture.pixels(x, y) = static_cast<std::uint8_t>(std::lround(255.0F * level));
    }
  }
  return picture;
}

/// Finds the points of the board in an image; false where there are too few.
bool find_points(const Image<float>& image,
                 const Board& board,
                 const PoseOptions& options,
                 PoseCapture& pose) {
  if (board.kind == BoardKind::Charuco) {
    CharucoSight sight = find_charuco(image, board);
    pose.mirrored_markers = std::max(pose.mirrored_markers, sight.mirrored_markers);
    if (sight.other) pose.other_board = sight.other;
    if (sight.points.size() >= options.min_points) pose.view.points = std::move(sight.points);
  } else {
    pose.view.points = find_board(image, board);
    if (pose.view.points.empty())
      if (auto other = find_other_charuco(image, board)) pose.other_board = std::move(other);
  }
  return !pose.view.points.empty();
}

/// The fringes alone; empty where there are none.
std::vector<FrameStack> without_white(std::span<const FrameStack> stacks) {
  std::vector<FrameStack> fringes;
  std::copy_if(stacks.begin(), stacks.end(), std::back_inserter(fringes), [](const auto& stack) {
    return stack.pattern.kind == PatternKind::Fringe && stack.exposure == 0;
  });
  return fringes;
}

}  // namespace

PoseCapture calibrate_measure_pose(std::span<const FrameStack> stacks,
                                   const Board& board,
                                   const Rig& known,
                                   const std::string& name,
                                   const PoseOptions& options,
                                   const Run& run) {
  PoseCapture pose;
  pose.view.name = name;
  Image<float> image = board_image(stacks);
  const bool found = find_points(image, board, options, pose);
  // A white frame that holds something else: the frames are out of step, and the fringes say so.
  if (const auto fringes = without_white(stacks);
      !found && !fringes.empty() && fringes.size() < stacks.size()) {
    Image<float> mean = board_image(fringes);
    if (find_points(mean, board, options, pose)) image = std::move(mean);
  }
  pose.image = measure_image_sharpness(image);
  if (options.keep_picture) pose.picture = picture_of(image);
  measure_light(stacks, image, known.reference().white_level, pose);
  if (pose.view.points.empty()) {
    if (board.kind == BoardKind::Checkerboard) pose.counted = count_corners(image);
    return pose;
  }
  calibrate_measure_faults(stacks, image, board, pose);
  for (const FringeDirection direction : {FringeDirection::Vertical, FringeDirection::Horizontal})
    add_projector_pixels(stacks, direction, known, options, run, pose.view.points);
  return pose;
}

}  // namespace frangia
