#include "frangia/calibrate/board.h"

#include <cmath>

#include <fmt/format.h>

#include "frangia/core/error.h"

namespace frangia {

std::vector<Eigen::Vector2d> board_points_mm(const Board& board) {
  std::vector<Eigen::Vector2d> points;
  for (int row = 0; row < board.rows; ++row) {
    for (int column = 0; column < board.columns; ++column)
      points.emplace_back(column * board.square_mm, row * board.square_mm);
  }
  return points;
}

void check_board(const Board& board) {
  constexpr int kFewest = 3;
  if (board.columns < kFewest || board.rows < kFewest) {
    throw Error(
        ErrorKind::Input,
        fmt::format("board.corners is [{}, {}]; count the inner corners, at least {} each way",
                    board.columns,
                    board.rows,
                    kFewest));
  }
  if (!(board.square_mm > 0.0) || !std::isfinite(board.square_mm)) {
    throw Error(ErrorKind::Input,
                fmt::format("board.square_mm is {}; give the side of a square in millimetres",
                            board.square_mm));
  }
}

}  // namespace frangia
