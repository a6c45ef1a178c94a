#include "frangia/simulate/internal/board_texture.h"

namespace frangia {

double board_albedo(const Board& board, const Eigen::Vector2d& point_mm) {
  constexpr double kInk = 0.06;  // reflectance of black laser print
  const Eigen::Vector2d half =
      0.5 * board.square_mm * Eigen::Vector2d(board.columns - 1, board.rows - 1);
  return is_printed_black(board, point_mm + half) ? kInk : 1.0;
}

}  // namespace frangia
