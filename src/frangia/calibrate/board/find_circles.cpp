#include "frangia/calibrate/board/find_circles.h"

#include <algorithm>

#include <opencv2/calib3d.hpp>

#include "frangia/calibrate/board/internal/opencv_image.h"
#include "frangia/calibrate/board/internal/refine_circle.h"

namespace frangia {
namespace {

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
