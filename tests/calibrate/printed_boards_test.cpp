#include "frangia/calibrate/board/printed_boards.h"

#include <cmath>
#include <filesystem>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "frangia/calibrate/board/write_board_pdf.h"
#include "frangia/core/angles.h"

#include "support/error_of.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

constexpr int kImageWidth = 640;
constexpr int kImageHeight = 512;

/// A board in the image plane, turned and seen with a perspective, 3 x 3 samples a pixel: as wide
/// as `share` of the image.
Image<float> view_of_board(const Board& board, double share, double turn_rad) {
  constexpr int kSamples = 3;
  const double width_mm = board.square_mm * (board.columns + 1);
  const double mm_per_px = width_mm / (share * kImageWidth);
  const Eigen::Vector2d middle_mm =
      0.5 * board.square_mm * Eigen::Vector2d(board.columns - 1, board.rows - 1);
  const Eigen::Rotation2Dd turn(turn_rad);
  Image<float> image(kImageWidth, kImageHeight);
  for (int y = 0; y < kImageHeight; ++y) {
    for (int x = 0; x < kImageWidth; ++x) {
      int white = 0;
      for (int i = 0; i < kSamples * kSamples; ++i) {
        const Eigen::Vector2d px(x - 0.5 * kImageWidth + (i % kSamples) / double{kSamples},
                                 y - 0.5 * kImageHeight + (i / kSamples) / double{kSamples});
        const double scale = mm_per_px * (1.0 + 2e-4 * px.x());
        white += is_printed_black(board, middle_mm + turn * (scale * px)) ? 0 : 1;
      }
      image(x, y) = static_cast<float>(20.0 + 180.0 * white / (kSamples * kSamples));
    }
  }
  return image;
}

TEST(PrintedBoards, FillTheirPaperWithWholeMillimetres) {
  const testing::TemporaryFolder folder;
  for (const PrintedBoard& printed : kPrintedBoards) {
    Board largest = printed.board();
    largest.square_mm = 0.0;
    const PaperSize paper = paper_size(std::string(printed.paper));
    EXPECT_EQ(write_board_pdf(folder.path() / "board.pdf", largest, paper).square_mm,
              printed.square_mm)
        << printed.paper;
  }
  EXPECT_NE(testing::error_of([] { static_cast<void>(printed_board("a6")); }), "");
}

TEST(PrintedBoards, SayByTheirMarkersWhichTheyAre) {
  for (const PrintedBoard& printed : kPrintedBoards) {
    const auto named =
        recognize_printed_board(view_of_board(printed.board(), 0.7, rad_from_deg(20)));
    ASSERT_TRUE(named) << printed.paper;
    EXPECT_EQ(named->square_mm, printed.square_mm);
    EXPECT_EQ(named->columns, printed.columns);
    EXPECT_EQ(named->rows, printed.rows);
    EXPECT_EQ(named->first_id, printed.first_id);
  }
}

TEST(PrintedBoards, AreNamedWhenAPartIsOutsideOfTheImage) {
  const auto named = recognize_printed_board(view_of_board(printed_board("a4"), 1.4, 0.1));
  ASSERT_TRUE(named);
  EXPECT_EQ(named->square_mm, 22.0);
}

TEST(PrintedBoards, AreNoBoardsOfOthers) {
  Board other = printed_board("a4");
  other.kind = BoardKind::Checkerboard;
  EXPECT_FALSE(recognize_printed_board(view_of_board(other, 0.7, 0.2)));
  other.kind = BoardKind::Charuco;
  other.first_id = 0;
  EXPECT_FALSE(recognize_printed_board(view_of_board(other, 0.7, 0.2))) << "ids from 0 on";
  other.first_id = printed_board("a4").first_id;
  other.columns = 7;
  other.rows = 10;
  EXPECT_FALSE(recognize_printed_board(view_of_board(other, 0.5, 0.2))) << "other rows";
}

}  // namespace
}  // namespace frangia
