#include "frangia/calibrate/board/count_corners.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "frangia/calibrate/board/internal/opencv_image.h"

namespace frangia {

std::optional<std::array<int, 2>> count_corners(const Image<float>& counts) {
  const cv::Mat linear = opencv_view(counts);
  const std::array pictures = {display_bytes(linear), equalized(linear)};
  constexpr std::array kScales = {0.35, 0.5, 0.7, 1.0};
  // A grid grows from its first corners and may stop early or take in the board's edge, differently
  // at each scale: the size that is found most often counts, of equals the larger.
  std::map<std::array<int, 2>, int> found;
  for (const double scale : kScales) {
    for (const cv::Mat& bytes : pictures) {
      cv::Mat scaled;
      cv::resize(bytes, scaled, {}, scale, scale, cv::INTER_AREA);
      std::vector<cv::Point2f> corners;
      cv::Mat grid;
      constexpr int kFlags =
          cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_EXHAUSTIVE | cv::CALIB_CB_LARGER;
      constexpr int kLeast = 3;
      // A grid of the least size is found in noise, too.
      if (cv::findChessboardCornersSB(scaled, cv::Size(kLeast, kLeast), corners, kFlags, grid) &&
          std::max(grid.cols, grid.rows) > kLeast)
        ++found[{std::max(grid.cols, grid.rows), std::min(grid.cols, grid.rows)}];
    }
  }
  const auto best = std::max_element(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return std::pair(a.second, a.first[0] * a.first[1]) <
           std::pair(b.second, b.first[0] * b.first[1]);
  });
  if (best == found.end()) return std::nullopt;
  return best->first;
}

}  // namespace frangia
