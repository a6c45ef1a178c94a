// The table [board] of scan.toml.
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "frangia/dataset/scan_folder.h"
#include "frangia/dataset/write_scan.h"

#include "support/error_of.h"
#include "support/small_folder.h"

namespace frangia {
namespace {

using testing::SmallFolder;

/// The message of a scan.toml that ends with these lines; empty when it is read.
std::string fault_of(const std::string& lines) {
  const SmallFolder folder;
  std::ofstream(folder.path() / "scan.toml", std::ios::app) << "\n[board]\n" << lines;
  return testing::error_of([&] { static_cast<void>(read_scan(folder.path())); });
}

TEST(ReadBoard, ReadsBackEveryKind) {
  const SmallFolder folder;
  Scan scan = read_scan(folder.path());
  for (const Board& board :
       {Board{.kind = BoardKind::Checkerboard, .columns = 10, .rows = 7, .square_mm = 12.5},
        Board{.kind = BoardKind::Circles, .columns = 11, .rows = 8, .square_mm = 20.0},
        Board{.kind = BoardKind::Charuco,
        .columns = 7,
        .rows = 5,
        .square_mm = 20.0,
        .marker_mm = 15.0,
        .dictionary = "DICT_6X6_250",
        .legacy_layout = true}}) {
    scan.board = board;
    write_scan(scan);
    const auto back = read_scan(folder.path()).board;
    ASSERT_TRUE(back);
    EXPECT_EQ(back->kind, board.kind);
    EXPECT_EQ(back->columns, board.columns);
    EXPECT_EQ(back->rows, board.rows);
    EXPECT_EQ(back->square_mm, board.square_mm);
    EXPECT_EQ(marker_side_mm(*back), marker_side_mm(board));
    EXPECT_EQ(circle_diameter_mm(*back), circle_diameter_mm(board));
    if (board.kind == BoardKind::Charuco) {
      EXPECT_EQ(back->dictionary, board.dictionary);
      EXPECT_TRUE(back->legacy_layout);
    }
  }
}

TEST(ReadBoard, NamesTheKeyOfAWrongValue) {
  const std::string kind = "kind = \"checkerboard\"\n";
  EXPECT_EQ(fault_of(kind + "corners = [10, 7]\nsquare_mm = 15\n"), "");
  EXPECT_NE(fault_of("kind = \"chess\"\n").find("board.kind is \"chess\""), std::string::npos);
  EXPECT_NE(fault_of(kind + "square_mm = 15\n").find("board.corners is missing"),
            std::string::npos);
  EXPECT_NE(fault_of(kind + "corners = [10, 7]\nsquare_mm = 0\n").find("board.square_mm is 0"),
            std::string::npos);
  EXPECT_NE(fault_of(kind + "corners = [10, nan]\nsquare_mm = 15\n").find("board.corners"),
            std::string::npos);
  EXPECT_NE(fault_of(kind + "corners = [2, 7]\nsquare_mm = 15\n").find("board.corners"),
            std::string::npos);
}

TEST(ReadScan, ReadsAPatternOfWhiteLight) {
  const SmallFolder folder;
  Scan scan = read_scan(folder.path());
  scan.patterns.push_back({.name = "white", .kind = PatternKind::White});
  write_scan(scan);
  const Scan back = read_scan(folder.path());
  EXPECT_EQ(back.patterns.back().kind, PatternKind::White);
  EXPECT_EQ(back.patterns.back().frame_count(), 1);
}

}  // namespace
}  // namespace frangia
