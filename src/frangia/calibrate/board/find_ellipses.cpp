#include "frangia/calibrate/board/find_ellipses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <opencv2/imgproc.hpp>

#include "frangia/calibrate/board/internal/opencv_image.h"
#include "frangia/core/angles.h"

namespace frangia {
namespace {

constexpr double kLeastHalfAxis_px = 1.8;  // a narrower spot has no flat middle
constexpr double kSlimmest = 0.2;          // ratio of the axes: seen at 78 degrees

/// The ellipse of an outline; none where the outline leaves it by more than whole pixels do.
std::optional<FoundEllipse> ellipse_of(const std::vector<cv::Point>& outline) {
  constexpr std::size_t kFewest = 10;
  if (outline.size() < kFewest) return std::nullopt;
  const cv::RotatedRect box = cv::fitEllipse(outline);
  const double turn = rad_from_deg(static_cast<double>(box.angle));
  Eigen::Matrix2d axes;
  axes << std::cos(turn), -std::sin(turn), std::sin(turn), std::cos(turn);
  axes.col(0) *= 0.5 * static_cast<double>(box.size.width);
  axes.col(1) *= 0.5 * static_cast<double>(box.size.height);
  if (axes.col(0).norm() < axes.col(1).norm()) axes.col(0).swap(axes.col(1));
  const double shorter = axes.col(1).norm();
  if (shorter < kLeastHalfAxis_px || shorter < kSlimmest * axes.col(0).norm()) return std::nullopt;
  FoundEllipse found{{static_cast<double>(box.center.x), static_cast<double>(box.center.y)}, axes};
  const Eigen::Matrix2d to_circle = axes.inverse();
  double misfit = 0.0;
  for (const cv::Point& point : outline) {
    const Eigen::Vector2d away = Eigen::Vector2d(point.x, point.y) - found.center_px;
    misfit += std::abs((to_circle * away).norm() - 1.0);
  }
  constexpr double kMisfit_px = 0.6;  // of whole pixels along the shorter axis
  const double allowed = std::max(0.06, kMisfit_px / shorter);
  if (misfit > allowed * static_cast<double>(outline.size())) return std::nullopt;
  return found;
}

bool are_alike(const FoundEllipse& one, const FoundEllipse& other) {
  constexpr double kAlike = 0.15;  // of the shorter axis
  const double shorter = one.axes_px.col(1).norm();
  return (one.center_px - other.center_px).norm() < kAlike * shorter &&
         std::abs(one.axes_px.col(0).norm() - other.axes_px.col(0).norm()) < kAlike * shorter;
}

}  // namespace

std::vector<FoundEllipse> find_ellipses(const Image<float>& counts, TargetTone tone) {
  constexpr std::array kWindows = {15, 31, 63};  // px: wider than a spot separates it
  constexpr double kOffset = 6.0;                // of 255 counts
  const cv::Mat bytes = display_bytes(opencv_view(counts));
  std::vector<FoundEllipse> found;
  for (const int window : kWindows) {
    cv::Mat spots;
    const bool dark = tone == TargetTone::Dark;
    cv::adaptiveThreshold(bytes,
                          spots,
                          255,
                          cv::ADAPTIVE_THRESH_MEAN_C,
                          dark ? cv::THRESH_BINARY_INV : cv::THRESH_BINARY,
                          window,
                          dark ? kOffset : -kOffset);
    std::vector<std::vector<cv::Point>> outlines;
    cv::findContours(spots, outlines, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
    for (const std::vector<cv::Point>& outline : outlines) {
      const auto ellipse = ellipse_of(outline);
      if (!ellipse) continue;
      const bool known = std::any_of(found.begin(), found.end(), [&](const FoundEllipse& other) {
        return are_alike(*ellipse, other);
      });
      if (!known) found.push_back(*ellipse);
    }
  }
  return found;
}

}  // namespace frangia
