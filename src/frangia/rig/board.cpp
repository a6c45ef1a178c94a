#include "frangia/rig/board.h"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "frangia/core/error.h"

namespace frangia {

std::string name_of(BoardKind kind) {
  constexpr std::array kNames = {"checkerboard", "circles"};
  return kNames.at(static_cast<std::size_t>(kind));
}

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
  const bool circles = board.kind == BoardKind::Circles;
  if (board.columns < kFewest || board.rows < kFewest) {
    throw Error(ErrorKind::Input,
                fmt::format("board.{} is [{}, {}]; count the {}, at least {} each way",
                            circles ? "circles" : "corners",
                            board.columns,
                            board.rows,
                            circles ? "circles" : "inner corners",
                            kFewest));
  }
  if (!(board.square_mm > 0.0) || !std::isfinite(board.square_mm)) {
    throw Error(ErrorKind::Input,
                fmt::format("board.{} is {}; give the {} in millimetres",
                            circles ? "spacing_mm" : "square_mm",
                            board.square_mm,
                            circles ? "distance between two circles" : "side of a square"));
  }
}

}  // namespace frangia
