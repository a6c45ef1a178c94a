#include "frangia/calibrate/board/write_board_pdf.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include <fmt/format.h>
#include <hpdf.h>

#include "frangia/core/atomic_file.h"
#include "frangia/core/error.h"
#include "frangia/rig/aruco_dictionary.h"

namespace frangia {
namespace {

constexpr double kMargin_mm = 8.0;   // printers leave up to 6 mm white
constexpr double kRuler_mm = 100.0;  // length of the ruler
constexpr double kFoot_mm = 16.0;    // height of the ruler and the text below the board

float points(double mm) {
  constexpr double kPointsPerMm = 72.0 / 25.4;
  return static_cast<float>(mm * kPointsPerMm);
}

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
  return std::floor(std::min((paper.width_mm - 2.0 * kMargin_mm) / cells.x(),
                             (paper.height_mm - 2.0 * kMargin_mm - kFoot_mm) / cells.y()));
}

void draw_circles(HPDF_Page page, const Board& board, double left_mm, double bottom_mm) {
  for (const Eigen::Vector2d& center : board_points_mm(board)) {
    HPDF_Page_Circle(page,
                     points(left_mm + center.x() + 0.5 * board.square_mm),
                     points(bottom_mm + (board.rows - 0.5) * board.square_mm - center.y()),
                     points(0.5 * circle_diameter_mm(board)));
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
                          points(left_mm + board.square_mm + cell.x()),
                          points(top_mm - board.square_mm - cell.y() - cell_mm),
                          points(cell_mm),
                          points(cell_mm));
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

void draw_ruler(HPDF_Page page, double left_mm, double bottom_mm) {
  constexpr double kTick_mm = 3.0;
  HPDF_Page_SetLineWidth(page, points(0.2));
  for (int i = 0; i <= 10; ++i) {
    const double x = left_mm + kRuler_mm * i / 10.0;
    HPDF_Page_MoveTo(page, points(x), points(bottom_mm));
    HPDF_Page_LineTo(page, points(x), points(bottom_mm + (i % 5 == 0 ? 1.5 : 1.0) * kTick_mm));
  }
  HPDF_Page_MoveTo(page, points(left_mm), points(bottom_mm));
  HPDF_Page_LineTo(page, points(left_mm + kRuler_mm), points(bottom_mm));
  HPDF_Page_Stroke(page);
}

void write_line(
    HPDF_Doc document, HPDF_Page page, double left_mm, double bottom_mm, const std::string& text) {
  constexpr float kSize = 8.0F;  // points
  HPDF_Page_BeginText(page);
  HPDF_Page_SetFontAndSize(page, HPDF_GetFont(document, "Helvetica", nullptr), kSize);
  HPDF_Page_TextOut(page, points(left_mm), points(bottom_mm), text.c_str());
  HPDF_Page_EndText(page);
}

void save(HPDF_Doc document, const std::filesystem::path& path) {
  HPDF_SaveToStream(document);
  if (HPDF_GetError(document) != HPDF_OK) {
    throw Error(ErrorKind::Numeric,
                fmt::format("{}: the board cannot be drawn: libharu reports error {:#x}",
                            path.string(),
                            HPDF_GetError(document)));
  }
  std::vector<HPDF_BYTE> bytes(HPDF_GetStreamSize(document));
  HPDF_UINT32 size = static_cast<HPDF_UINT32>(bytes.size());
  HPDF_ResetStream(document);
  HPDF_ReadFromStream(document, bytes.data(), &size);
  AtomicFile file(path);
  file.stream().write(
      reinterpret_cast<const char*>(bytes.data()),  // NOLINT(*-reinterpret-cast) bytes are bytes
      static_cast<std::streamsize>(size));
  file.commit();
}

}  // namespace

PaperSize paper_size(const std::string& name) {
  if (name == "a4") return {297.0, 210.0};
  if (name == "a3") return {420.0, 297.0};
  require(name == "letter", "a board is printed on a4, a3 or letter");
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
  const std::unique_ptr<std::remove_pointer_t<HPDF_Doc>, void (*)(HPDF_Doc)> document(
      HPDF_New(nullptr, nullptr), HPDF_Free);
  HPDF_Page page = HPDF_AddPage(document.get());
  HPDF_Page_SetWidth(page, points(paper.width_mm));
  HPDF_Page_SetHeight(page, points(paper.height_mm));
  const Eigen::Vector2i cells = cells_of(board);
  const double left_mm = 0.5 * (paper.width_mm - cells.x() * board.square_mm);
  const double top_mm = paper.height_mm - kMargin_mm;
  if (board.kind == BoardKind::Circles) {
    draw_circles(page, board, left_mm, top_mm - cells.y() * board.square_mm);
  } else {
    draw_squares(page, board, left_mm, top_mm);
  }
  draw_ruler(page, kMargin_mm, kMargin_mm);
  const bool circles = board.kind == BoardKind::Circles;
  write_line(
      document.get(),
      page,
      kMargin_mm + kRuler_mm + 4.0,
      kMargin_mm + 4.0,
      fmt::format("The ruler is {:g} mm long. Print at 100 %; otherwise measure it and scale "
                  "{} by the ratio.",
                  kRuler_mm,
                  circles ? "spacing_mm" : "square_mm"));
  write_line(document.get(),
             page,
             kMargin_mm + kRuler_mm + 4.0,
             kMargin_mm,
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
                                           board.first_id == 0
                                               ? ""
                                               : fmt::format("   first_id = {}", board.first_id))
                             : ""));
  save(document.get(), path);
  return board;
}

}  // namespace frangia
