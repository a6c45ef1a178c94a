#pragma once

#include <vector>

#include <Eigen/Core>

namespace frangia {

/// A flat target with a grid of points that are found in images by themselves.
struct Board {
  int columns = 0;         ///< inner corners along the board's x
  int rows = 0;            ///< inner corners along the board's y
  double square_mm = 0.0;  ///< distance between neighboring corners
};

/// Nominal positions of the board's points in its own plane, row by row.
///
/// @shape    columns x rows points
/// @units    mm; the origin is the first corner
[[nodiscard]] std::vector<Eigen::Vector2d> board_points_mm(const Board& board);

/// Throws Error(Input) when a board has fewer than 3 x 3 points or no positive square.
void check_board(const Board& board);

}  // namespace frangia
