#include "frangia/calibrate/board/internal/opencv_image.h"

#include <algorithm>
#include <vector>

#include <Eigen/Core>
#include <opencv2/imgproc.hpp>

#include "frangia/core/linear_algebra.h"

namespace frangia {

cv::Mat opencv_view(const Image<float>& counts) {
  return {counts.height(),
          counts.width(),
          CV_32F,
          const_cast<float*>(counts.pixels().data())};  // NOLINT(*-const-cast) it is only read
}

cv::Mat display_bytes(const cv::Mat& counts) {
  double brightest = 0.0;
  cv::minMaxLoc(counts, nullptr, &brightest);
  constexpr double kGamma = 0.6;
  cv::Mat bright;
  cv::pow(cv::max(counts, 0.0) / std::max(brightest, 1.0), kGamma, bright);
  cv::Mat bytes;
  bright.convertTo(bytes, CV_8U, 255.0);
  return bytes;
}

cv::Mat equalized(const cv::Mat& counts) {
  cv::Mat bytes = display_bytes(counts);
  constexpr double kClipLimit = 4.0;
  cv::createCLAHE(kClipLimit, cv::Size(8, 8))->apply(bytes, bytes);
  return bytes;
}

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

cv::Point2f refine_corner(const cv::Mat& counts, const cv::Point2f& corner, int reach) {
  constexpr int kMargin = 4;  // px for smoothing and gradients
  const cv::Size half(reach + kMargin, reach + kMargin);
  const EvenedWindow window = even_light(counts, cv::Point(corner), half);
  if (window.counts.cols < 2 * half.width + 1 || window.counts.rows < 2 * half.height + 1)
    return corner;
  cv::Mat smooth;
  cv::GaussianBlur(window.counts, smooth, {}, 1.0);
  const cv::Point2f origin(window.origin);
  std::vector<cv::Point2f> refined = {corner - origin};
  cv::cornerSubPix(smooth,
                   refined,
                   cv::Size(reach, reach),
                   cv::Size(-1, -1),
                   cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-5));
  const cv::Point2f place = refined[0] + origin;
  return cv::norm(place - corner) < 1.0 ? place : corner;
}

}  // namespace frangia
