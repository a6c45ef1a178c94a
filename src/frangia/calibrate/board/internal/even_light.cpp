#include "frangia/calibrate/board/internal/even_light.h"

#include <algorithm>
#include <vector>

#include <Eigen/Core>
#include <opencv2/imgproc.hpp>

#include "frangia/core/solve_symmetric.h"

namespace frangia {
namespace {

/// The pixels of white squares away from edges.
cv::Mat bright_part(const cv::Mat& window) {
  std::vector<float> sorted(window.begin<float>(), window.end<float>());
  std::sort(sorted.begin(), sorted.end());
  const std::size_t tail = sorted.size() / 20;
  const float middle = 0.5F * (sorted[tail] + sorted[sorted.size() - 1 - tail]);
  cv::Mat bright = window > middle;
  constexpr int kBlur = 5;  // px: edges are spread by the lens
  cv::erode(bright, bright, cv::Mat::ones(kBlur, kBlur, CV_8U));
  return bright;
}

}  // namespace

EvenedWindow even_light(const cv::Mat& counts, const cv::Point& center, const cv::Size& half) {
  const cv::Rect wanted(
      center.x - half.width, center.y - half.height, 2 * half.width + 1, 2 * half.height + 1);
  const cv::Rect inside = wanted & cv::Rect(0, 0, counts.cols, counts.rows);
  if (inside.empty()) return {};
  const cv::Mat window = counts(inside);
  const cv::Mat bright = bright_part(window);
  const auto terms_at = [&](int x, int y) {
    return Eigen::Vector3d(1.0,
                           static_cast<double>(x) / inside.width - 0.5,
                           static_cast<double>(y) / inside.height - 0.5);
  };
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (int y = 0; y < inside.height; ++y) {
    for (int x = 0; x < inside.width; ++x) {
      if (bright.at<std::uint8_t>(y, x) == 0) continue;
      const Eigen::Vector3d terms = terms_at(x, y);
      normal += terms * terms.transpose();
      right += static_cast<double>(window.at<float>(y, x)) * terms;
    }
  }
  constexpr double kFewest = 12.0;  // pixels for three coefficients
  if (normal(0, 0) < kFewest) return {};
  const Eigen::Vector3d plane = solve_symmetric(normal, right);
  const double mean = right[0] / normal(0, 0);
  constexpr double kSteepest = 0.3;  // share of the mean; beyond it the bright part is no plane
  // A plane is lowest at one of the corners.
  const double lowest = plane[0] - 0.5 * (std::abs(plane[1]) + std::abs(plane[2]));
  if (!(mean > 0.0) || !(lowest > kSteepest * mean)) return {};
  EvenedWindow out{cv::Mat(inside.height, inside.width, CV_32F), inside.tl()};
  for (int y = 0; y < inside.height; ++y) {
    for (int x = 0; x < inside.width; ++x) {
      out.counts.at<float>(y, x) = static_cast<float>(static_cast<double>(window.at<float>(y, x)) *
                                                      mean / plane.dot(terms_at(x, y)));
    }
  }
  return out;
}

}  // namespace frangia
