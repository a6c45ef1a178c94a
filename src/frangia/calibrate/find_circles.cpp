#include "frangia/calibrate/find_circles.h"

#include <opencv2/calib3d.hpp>

#include "frangia/calibrate/internal/opencv_image.h"

namespace frangia {

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
  std::vector<Eigen::Vector2d> out;
  for (const cv::Point2f& center : centers)
    out.emplace_back(center.x, center.y);
  return out;
}

}  // namespace frangia
