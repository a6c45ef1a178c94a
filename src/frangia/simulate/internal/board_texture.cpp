#include "frangia/simulate/internal/board_texture.h"

#include <cmath>

namespace frangia {

double board_albedo(const Board& board, const Eigen::Vector2d& point_mm) {
  constexpr double kInk = 0.06;  // reflectance of black laser print
  const Eigen::Vector2d half(0.5 * (board.columns - 1), 0.5 * (board.rows - 1));
  const Eigen::Vector2d grid = point_mm / board.square_mm + half;  // 0, 1, ... at the points
  if (board.kind == BoardKind::Circles) {
    constexpr double kRadius = 0.3;  // of the spacing
    const Eigen::Vector2d nearest = grid.array().round();
    const bool on_grid =
        nearest.minCoeff() >= 0.0 && nearest.x() < board.columns && nearest.y() < board.rows;
    return on_grid && (grid - nearest).norm() < kRadius ? kInk : 1.0;
  }
  const int column = static_cast<int>(std::floor(grid.x())) + 1;
  const int row = static_cast<int>(std::floor(grid.y())) + 1;
  const bool on_board = column >= 0 && row >= 0 && column <= board.columns && row <= board.rows;
  return on_board && (column + row) % 2 == 0 ? kInk : 1.0;
}

}  // namespace frangia
