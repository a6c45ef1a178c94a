#include "frangia/calibrate/board/find_circles.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "frangia/calibrate/board/internal/even_light.h"
#include "frangia/calibrate/board/internal/opencv_image.h"
#include "frangia/core/solve_symmetric.h"

namespace frangia {
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

}  // namespace frangia
