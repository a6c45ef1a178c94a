#include "frangia/rig/board.h"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/rig/aruco_dictionary.h"

namespace frangia {
namespace {

[[noreturn]] void fail_board(const std::string& sentence) {
  throw Error(ErrorKind::Input, sentence);
}

/// Whether a square of a board with squares is black; (0, 0) is the square before the first point.
bool is_black_square(const Board& board, int column, int row) {
  const bool white_first =
      board.kind == BoardKind::Charuco && board.legacy_layout && (board.rows + 1) % 2 == 0;
  return (column + row) % 2 == (white_first ? 1 : 0);
}

/// Whether a marker is black at a point given as shares of its sides.
bool is_black_in_marker(const ArucoDictionary& dictionary, int marker, const Eigen::Vector2d& at) {
  const int all = dictionary.cells + 2;
  const int column = static_cast<int>(std::floor(at.x() * all)) - 1;
  const int row = static_cast<int>(std::floor(at.y() * all)) - 1;
  if (column < 0 || row < 0 || column >= dictionary.cells || row >= dictionary.cells) return true;
  const int bit = dictionary.cells * dictionary.cells - 1 - (row * dictionary.cells + column);
  return (aruco_bits(dictionary, marker) >> static_cast<unsigned>(bit) & 1U) == 0U;
}

void check_markers(const Board& board) {
  const auto dictionary = find_aruco_dictionary(board.dictionary);
  if (!dictionary) {
    fail_board(
        fmt::format("board.dictionary is \"{}\"; it must be one of DICT_4X4_50 to DICT_7X7_250, "
                    "with 50, 100 or 250 markers",
                    board.dictionary));
  }
  const std::size_t markers = marker_squares(board).size();
  if (board.first_id < 0) fail_board("board.first_id must not be negative");
  if (markers + static_cast<std::size_t>(board.first_id) >
      static_cast<std::size_t>(dictionary->markers)) {
    fail_board(fmt::format(
        "board.dictionary is \"{}\", but the board has {} markers from id {} on; choose "
        "a larger dictionary",
        board.dictionary,
        markers,
        board.first_id));
  }
  const double side_mm = marker_side_mm(board);
  if (!(side_mm > 0.0 && side_mm < board.square_mm)) {
    fail_board(fmt::format("board.marker_mm is {:g}; it must be above 0 and below square_mm = {:g}",
                           side_mm,
                           board.square_mm));
  }
}

}  // namespace

std::vector<Eigen::Vector2d> board_points_mm(const Board& board) {
  std::vector<Eigen::Vector2d> points;
  for (int row = 0; row < board.rows; ++row) {
    for (int column = 0; column < board.columns; ++column)
      points.emplace_back(column * board.square_mm, row * board.square_mm);
  }
  return points;
}

double circle_diameter_mm(const Board& board) {
  constexpr double kPrinted = 0.6;  // of the spacing
  if (board.kind != BoardKind::Circles) return 0.0;
  return board.diameter_mm > 0.0 ? board.diameter_mm : kPrinted * board.square_mm;
}

double marker_side_mm(const Board& board) {
  constexpr double kPrinted = 0.7;  // of a square
  if (board.kind != BoardKind::Charuco) return 0.0;
  return board.marker_mm != 0.0 ? board.marker_mm : kPrinted * board.square_mm;
}

std::vector<Eigen::Vector2i> marker_squares(const Board& board) {
  std::vector<Eigen::Vector2i> squares;
  for (int row = 0; row <= board.rows; ++row) {
    for (int column = 0; column <= board.columns; ++column)
      if (!is_black_square(board, column, row)) squares.emplace_back(column, row);
  }
  return squares;
}

bool is_printed_black(const Board& board, const Eigen::Vector2d& point_mm) {
  const Eigen::Vector2d grid = point_mm / board.square_mm;  // 0, 1, ... at the points
  if (board.kind == BoardKind::Circles) {
    const Eigen::Vector2d nearest = grid.array().round();
    return nearest.minCoeff() >= 0.0 && nearest.x() < board.columns && nearest.y() < board.rows &&
           (grid - nearest).norm() * board.square_mm < 0.5 * circle_diameter_mm(board);
  }
  const int column = static_cast<int>(std::floor(grid.x())) + 1;
  const int row = static_cast<int>(std::floor(grid.y())) + 1;
  if (column < 0 || row < 0 || column > board.columns || row > board.rows) return false;
  if (is_black_square(board, column, row)) return true;
  if (board.kind != BoardKind::Charuco) return false;
  const double side = marker_side_mm(board) / board.square_mm;
  const Eigen::Vector2d square(column - 1, row - 1);
  const Eigen::Vector2d at = ((grid - square).array() - 0.5) / side + 0.5;
  if (at.minCoeff() < 0.0 || at.maxCoeff() >= 1.0) return false;
  // Black and white squares alternate, so that half of those before this one hold markers.
  const int marker = board.first_id + (row * (board.columns + 1) + column) / 2;
  return is_black_in_marker(find_aruco_dictionary(board.dictionary).value(), marker, at);
}

void check_board(const Board& board) {
  constexpr int kFewest = 3;
  const bool circles = board.kind == BoardKind::Circles;
  if (board.columns < kFewest || board.rows < kFewest) {
    fail_board(fmt::format("board.{} is [{}, {}]; count the {}, at least {} each way",
                           circles ? "circles" : "corners",
                           board.columns,
                           board.rows,
                           circles ? "circles" : "inner corners",
                           kFewest));
  }
  if (!(board.square_mm > 0.0) || !std::isfinite(board.square_mm)) {
    fail_board(fmt::format("board.{} is {}; give the {} in millimetres",
                           circles ? "spacing_mm" : "square_mm",
                           board.square_mm,
                           circles ? "distance between two circles" : "side of a square"));
  }
  const double diameter_mm = circle_diameter_mm(board);
  if (circles && !(diameter_mm < board.square_mm)) {
    fail_board(
        fmt::format("board.diameter_mm is {:g}; it must be above 0 and below spacing_mm = {:g}",
                    diameter_mm,
                    board.square_mm));
  }
  if (board.kind == BoardKind::Charuco) check_markers(board);
}

}  // namespace frangia
