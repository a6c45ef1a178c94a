// The table [board] of scan.toml.
#include <fstream>
#include <iterator>
#include <string>
#include <variant>
#include <vector>

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
        .first_id = 18,
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
      EXPECT_EQ(back->first_id, 18);
      EXPECT_TRUE(back->legacy_layout);
    }
  }
}

TEST(ReadBoard, ReadsBackEveryArtifact) {
  const SmallFolder folder;
  Scan scan = read_scan(folder.path());
  for (const Artifact& artifact : std::vector<Artifact>{
           Screen{1920, 1080, 0.2745}, Plate{}, Balls{25.4, {}}, Balls{40.0, 70.0}}) {
    scan.artifact = artifact;
    write_scan(scan);
    const Scan back = read_scan(folder.path());
    ASSERT_TRUE(back.artifact);
    EXPECT_FALSE(back.board);
    EXPECT_EQ(name_of(*back.artifact), name_of(artifact));
    if (const auto* screen = std::get_if<Screen>(&*back.artifact)) {
      EXPECT_EQ(screen->height_px, 1080);
      EXPECT_EQ(screen->pixel_mm, 0.2745);
    }
    if (const auto* balls = std::get_if<Balls>(&*back.artifact)) {
      EXPECT_EQ(balls->diameter_mm, std::get<Balls>(artifact).diameter_mm);
      EXPECT_EQ(balls->spacing_mm, std::get<Balls>(artifact).spacing_mm);
    }
  }
}

TEST(ReadBoard, NamesTheKeyOfAWrongArtifact) {
  const auto names = [](const std::string& lines, const char* part) {
    EXPECT_NE(fault_of(lines).find(part), std::string::npos) << fault_of(lines);
  };
  names("kind = \"screen\"\nsize_px = [0, 1080]\npixel_mm = 0.25\n", "board.size_px");
  names("kind = \"screen\"\nsize_px = [1920, 8]\npixel_mm = 0.25\n", "board.size_px is [1920, 8]");
  names("kind = \"screen\"\nsize_px = [1920, 1080]\npixel_mm = 0\n", "board.pixel_mm is 0");
  names("kind = \"ball\"\n", "board.diameter_mm is missing");
  names("kind = \"ball-bar\"\ndiameter_mm = 40\nspacing_mm = -1\n", "board.spacing_mm is -1");
  names("kind = \"ball-bar\"\ndiameter_mm = 40\nspacing_mm = 30\n", "would overlap");
}

TEST(ReadBoard, ReadsPatternsOfAScreen) {
  const SmallFolder folder;
  std::ofstream(folder.path() / "scan.toml", std::ios::app)
      << "\n[[pattern]]\nname = \"shown\"\nkind = \"fringe\"\nsource = \"screen\"\n"
         "direction = \"horizontal\"\nperiod_px = 270\nshifts_deg = [0, 120, 240]\n";
  Scan scan = read_scan(folder.path());
  EXPECT_EQ(scan.patterns.back().source, PatternSource::Screen);
  EXPECT_EQ(scan.patterns.back().period_px, 270.0);
  write_scan(scan);
  EXPECT_EQ(read_scan(folder.path()).patterns.back().source, PatternSource::Screen);
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
