#include "frangia/calibrate/find_board.h"

#include <optional>

#include <Eigen/Core>

#include "frangia/calibrate/find_checkerboard.h"
#include "frangia/calibrate/find_circles.h"
#include "frangia/core/error.h"

namespace frangia {

std::vector<BoardPoint> find_board(const Image<float>& counts, const Board& board) {
  check_board(board);
  std::optional<std::vector<Eigen::Vector2d>> pixels;
  switch (board.kind) {
    case BoardKind::Checkerboard:
      pixels = find_checkerboard(counts, board);
      break;
    case BoardKind::Circles:
      pixels = find_circles(counts, board);
      break;
    case BoardKind::Charuco:
      throw Error(
          ErrorKind::Input,
          "board.kind is \"charuco\", which this program cannot find; use \"checkerboard\"");
  }
  std::vector<BoardPoint> points;
  if (!pixels) return points;
  for (std::size_t i = 0; i < pixels->size(); ++i) {
    BoardPoint point;
    point.index = static_cast<int>(i);
    point.camera_px = (*pixels)[i];
    points.push_back(point);
  }
  return points;
}

}  // namespace frangia
