#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "frangia/core/image.h"
#include "frangia/rig/board.h"

namespace frangia {

/// A board that is printed for a size of paper. Its markers have ids of its own, so that an image
/// of it tells its numbers of corners and the side of its squares.
struct PrintedBoard {
  std::string_view paper;  ///< as `paper_size`
  int columns = 10;        ///< inner corners along x
  int rows = 7;            ///< inner corners along y
  double square_mm = 0.0;  ///< largest whole number that fits on the paper; printed at true scale
  int first_id = 0;        ///< of the first marker in DICT_5X5_250
  [[nodiscard]] Board board() const;  ///< as it is printed and found
};

/// All of them. Boards of one size of square have the same markers. The ids begin above those of
/// boards that others print from id 0.
inline constexpr std::array<PrintedBoard, 4> kPrintedBoards{
    {{.paper = "a4", .square_mm = 22.0, .first_id = 72},
     {.paper = "letter", .square_mm = 22.0, .first_id = 72},
     {.paper = "a3", .square_mm = 33.0, .first_id = 116},
     {.paper = "a5", .square_mm = 14.0, .first_id = 160}}};

/// The board for a size of paper.
///
/// @errors   Error(Input) for a size without one
[[nodiscard]] Board printed_board(std::string_view paper);

/// The printed board that an image shows, with the side of its squares as printed at true scale.
///
/// @shape    image of the mean intensity
/// @missing  nullopt: no such board, or too little of it for a certain answer
[[nodiscard]] std::optional<Board> recognize_printed_board(const Image<float>& counts);

}  // namespace frangia
