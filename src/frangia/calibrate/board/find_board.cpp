#include "frangia/calibrate/board/find_board.h"

#include "frangia/calibrate/board/find_charuco.h"
#include "frangia/calibrate/board/find_checkerboard.h"
#include "frangia/calibrate/board/find_circles.h"

namespace frangia {

std::vector<BoardPoint> find_board(const Image<float>& counts, const Board& board) {
  check_board(board);
  if (board.kind == BoardKind::Charuco) return find_charuco(counts, board).points;
  const auto pixels = board.kind == BoardKind::Circles ? find_circles(counts, board)
                                                       : find_checkerboard(counts, board);
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
