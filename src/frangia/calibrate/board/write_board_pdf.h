#pragma once

#include <filesystem>
#include <string>

#include "frangia/rig/board.h"

namespace frangia {

/// Size of a sheet of paper, the longer side first.
struct PaperSize {
  double width_mm = 297.0;   ///< longer side; A4
  double height_mm = 210.0;  ///< shorter side; A4
};

/// The sheet of a name: "a5", "a4", "a3" or "letter".
///
/// @errors   Error(Input) for another name
[[nodiscard]] PaperSize paper_size(const std::string& name);

/// Writes a board to print at true scale as PDF, with a ruler to check the scale. Returns the board
/// as drawn: a `square_mm` of 0 chooses the largest whole number of millimetres that fits.
///
/// A checkerboard must not look the same turned by 180 degrees, so that its corners have one order:
/// one of its numbers of squares is odd and one even.
/// @units    mm
/// @errors   Error(Input) when the checkerboard is symmetric or the board does not fit on the
///           paper; Error(File) when the file cannot be written
Board write_board_pdf(const std::filesystem::path& path,
                      const Board& board,
                      const PaperSize& paper = {});

}  // namespace frangia
