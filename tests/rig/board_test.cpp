// The picture is what OpenCV 4.6 draws: cv2.aruco.CharucoBoard_create(5, 4, 10, 7,
// DICT_5X5_100).draw((500, 400)), one character for each tenth of a square.
#include "frangia/rig/board.h"

#include <array>
#include <string_view>

#include <gtest/gtest.h>

#include "frangia/rig/aruco_dictionary.h"

#include "support/error_of.h"

namespace frangia {
namespace {

const Board kCharucoBoard{
    .kind = BoardKind::Charuco, .columns = 4, .rows = 3, .square_mm = 10.0, .marker_mm = 7.0};

TEST(Board, PrintsTheCharucoBoardOfOpenCv) {
  constexpr std::array<std::string_view, 20> kDrawn = {
      "##########..........##########..........##########",
      "##########.#######..##########.#######..##########",
      "##########.#.#.###..##########.#####.#..##########",
      "##########.##.#..#..##########.#..####..##########",
      "##########.##..###..##########.#####.#..##########",
      "##########.#.#.#.#..##########.#.#...#..##########",
      "##########.#...###..##########.###..##..##########",
      "##########.#######..##########.#######..##########",
      "##########..........##########..........##########",
      "##########..........##########..........##########",
      "..........##########..........##########..........",
      ".#######..##########.#######..##########.#######..",
      ".#..#.##..##########.#.#####..##########.#..#.##..",
      ".#....##..##########.###...#..##########.#...#.#..",
      ".####..#..##########.###.#.#..##########.##..#.#..",
      ".#.#..##..##########.##....#..##########.##.##.#..",
      ".#...#.#..##########.#.#...#..##########.###.###..",
      ".#######..##########.#######..##########.#######..",
      "..........##########..........##########..........",
      "..........##########..........##########.........."};
  for (int row = 0; row < 20; ++row) {
    for (int column = 0; column < 50; ++column) {
      // The first point is the far corner of the first square.
      const Eigen::Vector2d point(column + 0.6 - 10.0, row + 0.6 - 10.0);
      EXPECT_EQ(is_printed_black(kCharucoBoard, point),
                kDrawn.at(static_cast<std::size_t>(row))[static_cast<std::size_t>(column)] == '#')
          << column << ", " << row;
    }
  }
  EXPECT_FALSE(is_printed_black(kCharucoBoard, {-10.1, -5.0}));
}

TEST(Board, StartsWithAWhiteSquareInTheLegacyLayoutOfEvenRows) {
  Board legacy = kCharucoBoard;  // four rows of squares
  legacy.legacy_layout = true;
  EXPECT_EQ(marker_squares(legacy).front(), Eigen::Vector2i(0, 0));
  EXPECT_EQ(marker_squares(kCharucoBoard).front(), Eigen::Vector2i(1, 0));
  legacy.rows = 4;
  EXPECT_EQ(marker_squares(legacy).front(), Eigen::Vector2i(1, 0));
}

TEST(Board, RefusesMarkersThatDoNotFit) {
  Board board = kCharucoBoard;
  board.marker_mm = 10.0;
  EXPECT_EQ(testing::error_of([&] { check_board(board); }),
            "board.marker_mm is 10; it must be above 0 and below square_mm = 10");
  board = kCharucoBoard;
  board.dictionary = "DICT_8X8_50";
  EXPECT_NE(testing::error_of([&] { check_board(board); }).find("DICT_4X4_50 to DICT_7X7_250"),
            std::string::npos);
  board.dictionary = "DICT_4X4_50";
  board.columns = 12;
  board.rows = 9;
  EXPECT_NE(testing::error_of([&] { check_board(board); }).find("the board has 65 markers"),
            std::string::npos);
  EXPECT_FALSE(find_aruco_dictionary("DICT_4X4_1000"));
}

}  // namespace
}  // namespace frangia
