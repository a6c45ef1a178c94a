#include "frangia/calibrate/board/write_board_pdf.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <hpdf.h>

#include "frangia/calibrate/board/internal/pdf_page.h"
#include "frangia/core/error.h"
#include "frangia/rig/aruco_dictionary.h"

namespace frangia {
namespace {

/// Number of cells along a side: squares of a checkerboard, circles of a grid.
Eigen::Vector2i cells_of(const Board& board) {
  const int more = board.kind == BoardKind::Circles ? 0 : 1;
  return {board.columns + more, board.rows + more};
}

void check_cells(const Board& board) {
  const Eigen::Vector2i cells = cells_of(board);
  if (board.kind != BoardKind::Checkerboard || cells.sum() % 2 == 1) return;
  throw Error(ErrorKind::Input,
              fmt::format("a board of {} x {} squares looks the same upside down; let one number "
                          "of `corners` be odd and the other even",
                          cells.x(),
                          cells.y()));
}

double largest_square_mm(const Board& board, const PaperSize& paper) {
  const Eigen::Vector2i cells = cells_of(board);
  return std::floor(std::min((paper.width_mm - 2.0 * kPdfMargin_mm) / cells.x(),
                             (paper.height_mm - 2.0 * kPdfMargin_mm - kPdfFoot_mm) / cells.y()));
}

void draw_circles(HPDF_Page page, const Board& board, double left_mm, double bottom_mm) {
  for (const Eigen::Vector2d& center : board_points_mm(board)) {
    HPDF_Page_Circle(page,
                     pdf_points(left_mm + center.x() + 0.5 * board.square_mm),
                     pdf_points(bottom_mm + (board.rows - 0.5) * board.square_mm - center.y()),
                     pdf_points(0.5 * circle_diameter_mm(board)));
    HPDF_Page_Fill(page);
  }
}

/// Fills the black ones of `count` x `count` cells of a square whose corner is nearest to the
/// origin of the board.
void draw_square(HPDF_Page page,
                 const Board& board,
                 const Eigen::Vector2d& corner_mm,
                 double cell_mm,
                 int count,
                 double left_mm,
                 double top_mm) {
  for (int row = 0; row < count; ++row) {
    for (int column = 0; column < count; ++column) {
      const Eigen::Vector2d cell = corner_mm + cell_mm * Eigen::Vector2d(column, row);
      if (!is_printed_black(board, cell + Eigen::Vector2d::Constant(0.5 * cell_mm))) continue;
      HPDF_Page_Rectangle(page,
                          pdf_points(left_mm + board.square_mm + cell.x()),
                          pdf_points(top_mm - board.square_mm - cell.y() - cell_mm),
                          pdf_points(cell_mm),
                          pdf_points(cell_mm));
      HPDF_Page_Fill(page);
    }
  }
}

/// Draws the squares and the cells of the markers in them.
void draw_squares(HPDF_Page page, const Board& board, double left_mm, double top_mm) {
  for (int row = 0; row <= board.rows; ++row) {
    for (int column = 0; column <= board.columns; ++column) {
      const Eigen::Vector2d corner = board.square_mm * Eigen::Vector2d(column - 1, row - 1);
      draw_square(page, board, corner, board.square_mm, 1, left_mm, top_mm);
    }
  }
  if (board.kind != BoardKind::Charuco) return;
  const int cells = find_aruco_dictionary(board.dictionary).value().cells + 2;
  const double side_mm = marker_side_mm(board);
  for (const Eigen::Vector2i& square : marker_squares(board)) {
    const Eigen::Vector2d corner =
        board.square_mm * (square.cast<double>() - Eigen::Vector2d::Ones()) +
        Eigen::Vector2d::Constant(0.5 * (board.square_mm - side_mm));
    draw_square(page, board, corner, side_mm / cells, cells, left_mm, top_mm);
  }
}

}  // namespace

PaperSize paper_size(const std::string& name) {
  if (name == "a4") return {297.0, 210.0};
  if (name == "a5") return {210.0, 148.0};
  if (name == "a3") return {420.0, 297.0};
  require(name == "letter", "a board is printed on a5, a4, a3 or letter");
  return {279.4, 215.9};
}

Board write_board_pdf(const std::filesystem::path& path,
                      const Board& given,
                      const PaperSize& paper) {
  Board board = given;
  check_cells(board);
  const double most_mm = largest_square_mm(board, paper);
  if (board.square_mm == 0.0) board.square_mm = most_mm;
  check_board(board);
  if (board.square_mm > most_mm) {
    throw Error(
        ErrorKind::Input,
        fmt::format("squares of {:g} mm do not fit on paper of {:g} x {:g} mm; set `square` "
                    "to {:g} mm or less",
                    board.square_mm,
                    paper.width_mm,
                    paper.height_mm,
                    most_mm));
  }
  const PdfDocument document = new_pdf();
  HPDF_Page page = add_pdf_page(document, paper);
  const Eigen::Vector2i cells = cells_of(board);
  const double left_mm = 0.5 * (paper.width_mm - cells.x() * board.square_mm);
  const double top_mm = paper.height_mm - kPdfMargin_mm;
  if (board.kind == BoardKind::Circles) {
    draw_circles(page, board, left_mm, top_mm - cells.y() * board.square_mm);
  } else {
    draw_squares(page, board, left_mm, top_mm);
  }
  draw_pdf_ruler(page);
  const bool circles = board.kind == BoardKind::Circles;
  write_pdf_line(
      document,
      page,
      kPdfMargin_mm + kPdfRuler_mm + 4.0,
      kPdfMargin_mm + 4.0,
      fmt::format("The ruler is {:g} mm long. Print at 100 %; otherwise measure it and scale "
                  "{} by the ratio.",
                  kPdfRuler_mm,
                  circles ? "spacing_mm" : "square_mm"));
  write_pdf_line(document,
                 page,
                 kPdfMargin_mm + kPdfRuler_mm + 4.0,
                 kPdfMargin_mm,
                 fmt::format("[board]  kind = \"{}\"   {} = [{}, {}]   {} = {:g}{}",
                             name_of(board.kind),
                             circles ? "circles" : "corners",
                             board.columns,
                             board.rows,
                             circles ? "spacing_mm" : "square_mm",
                             board.square_mm,
                             board.kind == BoardKind::Charuco
                                 ? fmt::format("   marker_mm = {:g}   dictionary = \"{}\"{}",
                                               marker_side_mm(board),
                                               board.dictionary,
                                               board.first_id == 0 ? ""
                                                                   : fmt::format("   first_id = {}",
                                                                                 board.first_id))
                                 : ""));
  save_pdf(document, path);
  return board;
}

}  // namespace frangia
