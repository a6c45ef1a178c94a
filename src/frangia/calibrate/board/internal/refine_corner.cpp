#include "frangia/calibrate/board/internal/refine_corner.h"

#include <vector>

#include <opencv2/imgproc.hpp>

#include "frangia/calibrate/board/internal/even_light.h"

namespace frangia {

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
