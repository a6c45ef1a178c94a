#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace frangia {

/// Kinds of boards whose points are found in images.
enum class BoardKind {
  Checkerboard,  ///< inner corners of a checkerboard
  Circles        ///< centers of the dark circles of a rectangular grid
};

/// A flat target with a grid of points; the `[board]` table of scan.toml.
struct Board {
  BoardKind kind = BoardKind::Checkerboard;  ///< what the points are
  int columns = 0;                           ///< points along the board's x
  int rows = 0;                              ///< points along the board's y
  double square_mm = 0.0;                    ///< distance between neighboring points
};

/// Name of a kind as scan.toml has it: "checkerboard" or "circles".
[[nodiscard]] std::string name_of(BoardKind kind);

/// Nominal positions of the board's points in its own plane, row by row.
///
/// @shape    columns x rows points
/// @units    mm; the origin is the first point
[[nodiscard]] std::vector<Eigen::Vector2d> board_points_mm(const Board& board);

/// Checks the numbers of a board.
///
/// @errors   Error(Input) when a board has fewer than 3 x 3 points or no positive distance between
///           points
void check_board(const Board& board);

}  // namespace frangia
