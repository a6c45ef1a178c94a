#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace frangia {

/// Kinds of boards whose points are found in images.
enum class BoardKind {
  Checkerboard,  ///< inner corners of a checkerboard
  Charuco,       ///< inner corners of a checkerboard with ArUco markers in its white squares
  Circles        ///< centers of the dark circles of a rectangular grid
};

/// A flat target with a grid of points; the `[board]` table of scan.toml.
struct Board {
  BoardKind kind = BoardKind::Checkerboard;  ///< what the points are
  int columns = 0;                           ///< points along the board's x
  int rows = 0;                              ///< points along the board's y
  double square_mm = 0.0;                    ///< distance between neighboring points
  std::string dictionary;                    ///< ChArUco: OpenCV's name without prefix: "5X5_100"
  double marker_mm = 0.0;                    ///< ChArUco: side of a marker
  /// ChArUco: the layout of OpenCV before 4.6, which differs for an even number of rows of squares.
  bool legacy_layout = false;
};

/// Name of a kind as scan.toml has it: "checkerboard", "charuco" or "circles".
[[nodiscard]] std::string name_of(BoardKind kind);

/// Nominal positions of the board's points in its own plane, row by row.
///
/// @shape    columns x rows points
/// @units    mm; the origin is the first point
[[nodiscard]] std::vector<Eigen::Vector2d> board_points_mm(const Board& board);

/// Checks the numbers of a board.
///
/// @errors   Error(Input) when a board has fewer than 3 x 3 points, no positive distance between
///           points, or a marker that is not smaller than its square
void check_board(const Board& board);

}  // namespace frangia
