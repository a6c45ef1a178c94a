#include "frangia/calibrate/board/find_checkerboard.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "frangia/calibrate/board/internal/opencv_image.h"
#include "frangia/calibrate/board/internal/refine_corner.h"

namespace frangia {
namespace {

/// Shortest distance between a corner and its neighbors in row and column.
double spacing_px(const std::vector<cv::Point2f>& corners, int columns) {
  double least = std::numeric_limits<double>::infinity();
  const auto step = static_cast<std::size_t>(columns);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i % step + 1 < step) least = std::min(least, cv::norm(corners[i + 1] - corners[i]));
    if (i + step < corners.size())
      least = std::min(least, cv::norm(corners[i + step] - corners[i]));
  }
  return least;
}

/// Corners to a pixel or better. Which treatment of the image succeeds depends on it: a board in
/// the dark is found without equalization, one in shadow with it.
std::optional<std::vector<cv::Point2f>> search(const cv::Mat& linear, const cv::Size& size) {
  struct Treatment {
    cv::Mat bytes;
    int flags;
  };
  const cv::Mat local = equalized(linear);
  const std::array<Treatment, 3> treatments{{{display_bytes(linear), cv::CALIB_CB_NORMALIZE_IMAGE},
                                             {local, 0},
                                             {local, cv::CALIB_CB_NORMALIZE_IMAGE}}};
  constexpr std::array kScales = {0.5, 1.0, 0.7, 0.35};
  for (const double scale : kScales) {
    for (const Treatment& treatment : treatments) {
      cv::Mat scaled;
      cv::resize(treatment.bytes, scaled, {}, scale, scale, cv::INTER_AREA);
      std::vector<cv::Point2f> corners;
      if (!cv::findChessboardCornersSB(scaled, size, corners, treatment.flags)) continue;
      for (cv::Point2f& corner : corners) {
        corner.x = static_cast<float>((corner.x + 0.5) / scale - 0.5);
        corner.y = static_cast<float>((corner.y + 0.5) / scale - 0.5);
      }
      return corners;
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::vector<Eigen::Vector2d>> find_checkerboard(const Image<float>& counts,
                                                              const Board& board) {
  check_board(board);
  const cv::Mat linear = opencv_view(counts);
  auto corners = search(linear, cv::Size(board.columns, board.rows));
  if (!corners) return std::nullopt;
  // A window that reaches almost to the next edges, where the gradients of others begin.
  constexpr double kReach = 0.3;
  const int reach =
      static_cast<int>(std::clamp(kReach * spacing_px(*corners, board.columns), 2.0, 20.0));
  cv::Mat smooth;
  cv::GaussianBlur(linear, smooth, {}, 1.0);
  cv::cornerSubPix(smooth,
                   *corners,
                   cv::Size(reach, reach),
                   cv::Size(-1, -1),
                   cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-5));
  std::vector<Eigen::Vector2d> found;
  for (const cv::Point2f& corner : *corners) {
    const cv::Point2f place = refine_corner(linear, corner, reach);
    found.emplace_back(place.x, place.y);
  }
  return found;
}

}  // namespace frangia
