#include "frangia/calibrate/board/printed_boards.h"

#include <algorithm>
#include <string>

#include "frangia/calibrate/board/find_board.h"
#include "frangia/calibrate/board/find_charuco.h"
#include "frangia/core/error.h"

namespace frangia {
namespace {

constexpr const char* kDictionary = "DICT_5X5_250";
/// Markers of a board that name it. Single squares of other things are read as markers now and
/// then, with any id.
constexpr std::size_t kFewestMarkersOfBoard = 8;
constexpr double kOfOneBoard = 0.9;  ///< share of all markers that must be of the board

bool has(const Board& board, const FoundMarker& marker) {
  return marker.code >= board.first_id &&
         marker.code < board.first_id + static_cast<int>(marker_squares(board).size());
}

}  // namespace

Board PrintedBoard::board() const {
  return {.kind = BoardKind::Charuco,
          .columns = columns,
          .rows = rows,
          .square_mm = square_mm,
          .dictionary = kDictionary,
          .first_id = first_id};
}

Board printed_board(std::string_view paper) {
  const auto* const found =
      std::find_if(kPrintedBoards.begin(), kPrintedBoards.end(), [&](const PrintedBoard& one) {
        return one.paper == paper;
      });
  require(found != kPrintedBoards.end(), "paper: a board is printed on a5, a4, a3 or letter");
  return found->board();
}

std::optional<Board> recognize_printed_board(const Image<float>& counts) {
  const std::vector<FoundMarker> markers = find_markers(counts, kDictionary);
  for (const PrintedBoard& printed : kPrintedBoards) {
    const Board board = printed.board();
    const auto own = static_cast<std::size_t>(
        std::count_if(markers.begin(), markers.end(), [&](const FoundMarker& marker) {
          return has(board, marker);
        }));
    if (own < kFewestMarkersOfBoard ||
        static_cast<double>(own) < kOfOneBoard * static_cast<double>(markers.size()))
      continue;
    // The ids alone could be those of a part of a larger board with other rows.
    if (!find_charuco(counts, board).points.empty()) return board;
  }
  return std::nullopt;
}

}  // namespace frangia
