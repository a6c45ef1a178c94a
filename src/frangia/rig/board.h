#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "frangia/core/enum_names.h"

namespace frangia {

/// Kinds of boards whose points are found in images.
enum class BoardKind {
  Checkerboard,  ///< inner corners of a checkerboard
  Circles,       ///< centers of the dark circles of a rectangular grid
  Charuco        ///< inner corners of a checkerboard whose white squares hold ArUco markers
};

/// What users call them.
[[nodiscard]] constexpr auto names_of(BoardKind /*any*/) {
  return EnumNames<BoardKind, 3>{{{BoardKind::Checkerboard, "checkerboard"},
                                  {BoardKind::Charuco, "charuco"},
                                  {BoardKind::Circles, "circles"}}};
}

/// A flat target with a grid of points; the `[board]` table of scan.toml.
struct Board {
  BoardKind kind = BoardKind::Checkerboard;  ///< what the points are
  int columns = 0;                           ///< points along the board's x
  int rows = 0;                              ///< points along the board's y
  double square_mm = 0.0;                    ///< distance between neighboring points
  double diameter_mm = 0.0;                  ///< of circles; 0: 0.6 of their distance, as printed
  double marker_mm = 0.0;                    ///< side of a marker; 0: 0.7 of a square, as printed
  std::string dictionary = "DICT_5X5_100";   ///< of the markers; see `find_aruco_dictionary`
  int first_id = 0;                          ///< of the first marker in the dictionary
  /// Layout of OpenCV before 4.6: a board with an even number of rows of squares starts with a
  /// white square.
  bool legacy_layout = false;
};

/// Nominal positions of the board's points in its own plane, row by row.
///
/// @shape    columns x rows points
/// @units    mm; the origin is the first point
[[nodiscard]] std::vector<Eigen::Vector2d> board_points_mm(const Board& board);

/// Diameter of the circles of a board; 0 for other boards.
///
/// @units    mm
[[nodiscard]] double circle_diameter_mm(const Board& board);

/// Side of the markers of a ChArUco board; 0 for other boards.
///
/// @units    mm
[[nodiscard]] double marker_side_mm(const Board& board);

/// The squares that hold the markers of a ChArUco board, in the order of the markers: the first
/// one holds the marker `first_id`.
///
/// @shape    column and row of each square; (0, 0) is the square before the first point
[[nodiscard]] std::vector<Eigen::Vector2i> marker_squares(const Board& board);

/// Whether a point of the board's plane is printed black.
///
/// @units    mm; the origin is the first point
[[nodiscard]] bool is_printed_black(const Board& board, const Eigen::Vector2d& point_mm);

/// Checks the numbers of a board.
///
/// @errors   Error(Input) when a board has fewer than 3 x 3 points or no positive distance between
///           points, when its circles or markers do not fit, or its dictionary is unknown or too
///           small
void check_board(const Board& board);

}  // namespace frangia
