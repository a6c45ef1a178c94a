#include "frangia/calibrate/count_corners.h"

#include <algorithm>
#include <vector>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "frangia/calibrate/internal/opencv_image.h"

namespace frangia {

std::optional<std::array<int, 2>> count_corners(const Image<float>& counts) {
  const cv::Mat linear = opencv_view(counts);
  const std::array pictures = {display_bytes(linear), equalized(linear)};
  constexpr std::array kScales = {0.5, 1.0};
  for (const double scale : kScales) {
    for (const cv::Mat& bytes : pictures) {
      cv::Mat scaled;
      cv::resize(bytes, scaled, {}, scale, scale, cv::INTER_AREA);
      std::vector<cv::Point2f> corners;
      cv::Mat grid;
      if (cv::findChessboardCornersSB(scaled,
                                      cv::Size(3, 3),
                                      corners,
                                      cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_LARGER,
                                      grid))
        return std::array{std::max(grid.cols, grid.rows), std::min(grid.cols, grid.rows)};
    }
  }
  return std::nullopt;
}

}  // namespace frangia
