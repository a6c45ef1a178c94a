#include "frangia/calibrate/board/internal/refine_circle.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <opencv2/imgproc.hpp>

#include "frangia/calibrate/board/internal/even_light.h"

namespace frangia {

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
  const Coefficients conic = normal.ldlt().solve(target);
  const Eigen::Vector2d shift = 0.5 * size_px * conic.tail<2>();
  constexpr double kFarthest = 0.1;  // steps
  if (!((circles_by_px * shift).norm() < kFarthest)) return center;
  return center + cv::Point2f(static_cast<float>(shift.x()), static_cast<float>(shift.y()));
}

}  // namespace frangia
