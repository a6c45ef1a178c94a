#include "frangia/calibrate/board/measure_sharpness.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "frangia/calibrate/board/internal/opencv_image.h"
#include "frangia/core/angles.h"
#include "frangia/core/statistics.h"

namespace frangia {
namespace {

/// The pixels about a point that are inside of the image.
cv::Rect window_about(const BoardPoint& point, int reach_px, const cv::Mat& image) {
  const cv::Point center(static_cast<int>(std::lround(point.camera_px.x())),
                         static_cast<int>(std::lround(point.camera_px.y())));
  const cv::Point half(reach_px, reach_px);
  return cv::Rect(center - half, center + half + cv::Point(1, 1)) &
         cv::Rect(0, 0, image.cols, image.rows);
}

}  // namespace

double measure_blur_px(const Image<float>& counts,
                       std::span<const BoardPoint> points,
                       int reach_px) {
  const cv::Mat linear = opencv_view(counts);
  cv::Mat along;
  cv::Mat across;
  cv::Sobel(linear, along, CV_32F, 1, 0, 3, 1.0 / 8.0);
  cv::Sobel(linear, across, CV_32F, 0, 1, 3, 1.0 / 8.0);
  std::vector<double> blurs;
  for (const BoardPoint& point : points) {
    const cv::Rect window = window_about(point, reach_px, linear);
    if (window.area() < reach_px * reach_px) continue;
    double least = 0.0;
    double most = 0.0;
    cv::minMaxLoc(linear(window), &least, &most);
    cv::Mat slope;
    cv::magnitude(along(window), across(window), slope);
    double steepest = 0.0;
    cv::minMaxLoc(slope, nullptr, &steepest);
    // A Gaussian edge of height h has the slope h / (sigma sqrt(2 pi)).
    if (steepest > 0.0) blurs.push_back((most - least) / (steepest * std::sqrt(kTwoPi)));
  }
  return blurs.empty() ? std::numeric_limits<double>::quiet_NaN() : median(blurs);
}

ImageSharpness measure_image_sharpness(const Image<float>& counts) {
  const cv::Mat linear = opencv_view(counts);
  cv::Mat along;
  cv::Mat across;
  cv::Mat slope;
  cv::Sobel(linear, along, CV_32F, 1, 0, 3, 1.0 / 8.0);
  cv::Sobel(linear, across, CV_32F, 0, 1, 3, 1.0 / 8.0);
  cv::magnitude(along, across, slope);
  const auto percentile = [](const cv::Mat& image, double share) {
    std::vector<float> values(image.begin<float>(), image.end<float>());
    const auto rank = values.begin() +
                      static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), rank, values.end());
    return static_cast<double>(*rank);
  };
  constexpr double kSteepest = 0.999;  // not the one pixel that is defect
  const double contrast = percentile(linear, 0.95) - percentile(linear, 0.05);
  return {contrast / (std::max(percentile(slope, kSteepest), 1e-9) * std::sqrt(kTwoPi)), contrast};
}

double measure_motion_px(const Image<float>& counts,
                         std::span<const BoardPoint> points,
                         int reach_px) {
  if (points.empty()) return 0.0;
  cv::Mat smooth;
  cv::GaussianBlur(opencv_view(counts), smooth, {}, 1.0);
  std::vector<cv::Point2f> corners;
  for (const BoardPoint& point : points) {
    corners.emplace_back(static_cast<float>(point.camera_px.x()),
                         static_cast<float>(point.camera_px.y()));
  }
  cv::cornerSubPix(smooth,
                   corners,
                   cv::Size(reach_px, reach_px),
                   cv::Size(-1, -1),
                   cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 50, 1e-3));
  std::vector<double> x;
  std::vector<double> y;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    x.push_back(corners[i].x - points[i].camera_px.x());
    y.push_back(corners[i].y - points[i].camera_px.y());
  }
  return std::hypot(median(x), median(y));
}

double measure_likeness(const Image<float>& counts,
                        const Image<float>& reference,
                        std::span<const BoardPoint> points,
                        int reach_px) {
  const cv::Mat here = opencv_view(counts);
  const cv::Mat there = opencv_view(reference);
  std::vector<double> likeness;
  for (const BoardPoint& point : points) {
    const cv::Rect window = window_about(point, reach_px, here);
    if (window.area() < reach_px * reach_px) continue;
    cv::Mat coefficient;
    cv::matchTemplate(here(window), there(window), coefficient, cv::TM_CCOEFF_NORMED);
    likeness.push_back(static_cast<double>(coefficient.at<float>(0, 0)));
  }
  return likeness.empty() ? std::numeric_limits<double>::quiet_NaN() : median(likeness);
}

}  // namespace frangia
