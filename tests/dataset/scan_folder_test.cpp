#include "frangia/dataset/scan_folder.h"

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "frangia/core/angles.h"
#include "frangia/dataset/read_frames.h"
#include "frangia/dataset/write_scan.h"
#include "frangia/frames/png.h"
#include "frangia/rig/paper_rig.h"
#include "frangia/rig/read_rig.h"

#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::TemporaryFolder;

const std::string kScan = R"(format = "frangia-scan"
version = 1
name = "wall"
[[pattern]]
name = "fringe"
kind = "fringe"
fringes_per_degree = 1.0
shifts_deg = [0, 90, 180, 270]
[[pattern]]
name = "line"
kind = "line"
[[view]]
angle_deg = 45.0
folder = "views/000"
)";

/// A scan folder of 12 x 10 pixels whose every frame is grey.
class SmallFolder {
 public:
  SmallFolder() {
    Rig rig = make_paper_rig({.columns = 12, .rows = 10});
    rig.turntable = Turntable{.point_mm = {0.0, 0.0, 490.0}};
    write_rig(path() / "rig.toml", rig);
    write_text("scan.toml", kScan);
    std::filesystem::create_directories(view());
    for (const char* name : {"fringe-0", "fringe-1", "fringe-2", "fringe-3", "line-0"})
      write_png(view() / (std::string(name) + ".png"), Frame(Image<std::uint8_t>(12, 10, 80)));
  }
  [[nodiscard]] const std::filesystem::path& path() const { return folder_.path(); }
  [[nodiscard]] std::filesystem::path view() const { return path() / "views/000"; }
  void write_text(const std::string& name, const std::string& text) const {
    std::ofstream(path() / name) << text;
  }
  void replace(const std::string& file, const std::string& from, const std::string& to) const {
    std::ifstream in(path() / file);
    std::string text((std::istreambuf_iterator<char>(in)), {});
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    write_text(file, text.replace(at, from.size(), to));
  }

 private:
  TemporaryFolder folder_;
};

/// The sentence of the error that reading the whole scan throws.
std::string complaint(const SmallFolder& folder) {
  try {
    const Scan scan = read_scan(folder.path());
    static_cast<void>(read_frames(scan, 0));
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Input);
    return error.what();
  }
  return "accepted";
}

void expect_names(const std::string& sentence, const std::string& what) {
  EXPECT_NE(sentence.find(what), std::string::npos) << sentence;
}

TEST(ReadScan, ReadsPatternsViewsAndFrames) {
  const SmallFolder folder;
  const Scan scan = read_scan(folder.path());
  EXPECT_EQ(scan.name, "wall");
  ASSERT_EQ(scan.patterns.size(), 2U);
  EXPECT_EQ(scan.patterns[0].frame_count(), 4);
  EXPECT_NEAR(scan.views[0].angle_rad, 0.785398, 1e-6);
  const auto stacks = read_frames(scan, 0);
  ASSERT_EQ(stacks.size(), 2U);
  EXPECT_EQ(stacks[0].frames.size(), 4U);
  EXPECT_EQ(counts_at(stacks[1].frames[0], 3, 3), 80);
}

TEST(ReadScan, ReadsBackWhatWriteScanWrote) {
  const SmallFolder folder;
  Scan scan = read_scan(folder.path());
  scan.name = R"(a "quoted" \ name)";
  write_scan(scan);
  const Scan back = read_scan(folder.path());
  EXPECT_EQ(back.name, scan.name);
  EXPECT_EQ(back.patterns[0].shifts_rad, scan.patterns[0].shifts_rad);
  EXPECT_EQ(back.views[0].folder, scan.views[0].folder);
}

TEST(ReadScanFault, AMissingFrameIsNamed) {
  const SmallFolder folder;
  std::filesystem::remove(folder.view() / "fringe-2.png");
  expect_names(complaint(folder), "fringe-2.png");
}

TEST(ReadScanFault, ASurplusFrameIsNamed) {
  const SmallFolder folder;
  std::filesystem::copy_file(folder.view() / "fringe-2.png", folder.view() / "fringe-4.png");
  expect_names(complaint(folder), "fringe-4.png");
}

TEST(ReadScanFault, AFrameOfAnotherSizeIsNamedWithBothSizes) {
  const SmallFolder folder;
  write_png(folder.view() / "fringe-1.png", Frame(Image<std::uint8_t>(13, 10, 80)));
  const std::string sentence = complaint(folder);
  expect_names(sentence, "fringe-1.png");
  expect_names(sentence, "13 x 10");
  expect_names(sentence, "12 x 10");
}

TEST(ReadScanFault, AColourFrameIsNamed) {
  const SmallFolder folder;
  write_png(folder.view() / "line-0.png", Image<Rgb>(12, 10));
  expect_names(complaint(folder), "colour");
}

TEST(ReadScanFault, ATruncatedFrameIsNamed) {
  const SmallFolder folder;
  const auto path = folder.view() / "fringe-3.png";
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  expect_names(complaint(folder), "fringe-3.png");
}

TEST(ReadScanFault, SixteenBitsAboveTheWhiteLevelAreNamed) {
  const SmallFolder folder;
  for (const char* name : {"fringe-0", "fringe-1", "fringe-2", "fringe-3", "line-0"}) {
    write_png(folder.view() / (std::string(name) + ".png"),
              Frame(Image<std::uint16_t>(12, 10, 3000)));
  }
  expect_names(complaint(folder), "white_level");
}

TEST(ReadScanFault, EightBitsUnderATwelveBitWhiteLevelAreNamed) {
  const SmallFolder folder;
  folder.replace("rig.toml", "white_level = 255", "white_level = 4095");
  expect_names(complaint(folder), "white_level");
}

TEST(ReadScanFault, AFrameOfAnotherDepthIsNamed) {
  const SmallFolder folder;
  write_png(folder.view() / "fringe-1.png", Frame(Image<std::uint16_t>(12, 10, 80)));
  expect_names(complaint(folder), "fringe-1.png");
}

struct Fault {
  std::string from;
  std::string to;
  std::string names;
};

class ScanTomlFault : public ::testing::TestWithParam<Fault> {};

TEST_P(ScanTomlFault, IsOneSentenceThatNamesFileAndKey) {
  const SmallFolder folder;
  folder.replace("scan.toml", GetParam().from, GetParam().to);
  const std::string sentence = complaint(folder);
  expect_names(sentence, GetParam().names);
  EXPECT_EQ(sentence.find('\n'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(
    All,
    ScanTomlFault,
    ::testing::Values(Fault{"[0, 90, 180, 270]", "[0, 90]", "pattern[0].shifts_deg"},
                      Fault{"[0, 90, 180, 270]", "[0, 90, nan, 270]", "pattern[0].shifts_deg"},
                      Fault{"fringes_per_degree = 1.0", "period_px = 20", "fringes_per_degree"},
                      Fault{"fringes_per_degree = 1.0", "fringes_per_degree = 0", "above 0"},
                      Fault{"kind = \"line\"", "kind = \"circle\"", "pattern[1].kind"},
                      Fault{"name = \"line\"", "name = \"fringe\"", "twice"},
                      Fault{"name = \"line\"", "name = \"../line\"", "pattern[1].name"},
                      Fault{"angle_deg = 45.0", "angle_deg = \"45\"", "view[0].angle_deg"},
                      Fault{"folder = \"views/000\"", "folder = \"views/001\"", "views/001"},
                      Fault{"folder = \"views/000\"", "folder = \"/views\"", "relative"},
                      Fault{"folder = \"views/000\"", "folder = \"../../etc\"", "inside"},
                      Fault{"folder = \"views/000\"", "folder = \"views/../..\"", "inside"},
                      Fault{"folder = \"views/000\"", "folder = \"\"", "inside"},
                      Fault{"angle_deg", "round = 1\nangle_deg", "is called setup now"},
                      Fault{
                          "[[view]]", "[[round]]\nround = 1\n[[view]]", "is called [[setup]] now"},
                      Fault{"[[view]]", "[[setup]]\nround = 1\n[[view]]", "is called number now"},
                      Fault{"[[view]]",
                            "[[setup]]\nnumber = 1\nshift_mm = [0, 0, 1]\n[[view]]",
                            "is called translation_mm now"},
                      Fault{"version = 1", "version = 3", "reads versions up to 2"},
                      Fault{"[[view]]", "[[vue]]", "[[view]]"}));

TEST(ReadScanFault, AViewsFolderThatIsALinkOutOfTheScanIsNamed) {
  const SmallFolder folder;
  const TemporaryFolder outside;
  std::filesystem::remove_all(folder.view());
  std::filesystem::create_directory_symlink(outside.path(), folder.view());
  expect_names(complaint(folder), "view[0].folder");
}

TEST(ReadScan, AcceptsAScanFolderThatIsALinkItself) {
  const SmallFolder folder;
  const TemporaryFolder outside;
  const std::filesystem::path link = outside.path() / "scan";
  std::filesystem::create_directory_symlink(folder.path(), link);
  EXPECT_EQ(read_frames(read_scan(link), 0).size(), 2U);
}

class UnfinishedScan : public ::testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(UnfinishedScan, IsSaidToBeNotComplete) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / GetParam().first);
  try {
    static_cast<void>(read_scan(folder.path()));
    FAIL();
  } catch (const Error& error) {
    expect_names(error.what(), "the scan is not complete");
    expect_names(error.what(), GetParam().second);
  }
}

INSTANTIATE_TEST_SUITE_P(All,
                         UnfinishedScan,
                         ::testing::Values(std::pair{"capture", "`scan`"},
                                           std::pair{"simulation-not-finished", "`simulate`"}));

TEST(WriteScan, KeepsEveryKindOfPatternAndEverySetup) {
  const SmallFolder folder;
  Scan scan = read_scan(folder.path());
  scan.rig.projector.model =
      PinholeModel{.width_px = 1280, .height_px = 800, .focal_px = {1900.0, 1900.0}};
  const double third_rad = rad_from_deg(120.0);
  scan.patterns = {{.name = "fine", .period_px = 20.0},
                   {.name = "code", .kind = PatternKind::Gray},
                   {.name = "ramp", .kind = PatternKind::Ramp}};
  scan.patterns[0].direction = FringeDirection::Horizontal;
  scan.patterns[0].shifts_rad = {0.0, third_rad, 2.0 * third_rad};
  scan.patterns[0].exposures_ms = {2.5, 10.0};
  scan.patterns[1].bits = 8;
  scan.patterns[1].stripe_px = 10.0;
  scan.patterns[2].levels = {0.0, 0.5, 1.0};
  scan.views.push_back({third_rad, "views/001", 1});
  scan.part_poses[1] = Eigen::Translation3d(0.0, 0.5, 70.0) *
                       Eigen::AngleAxisd(0.3, Eigen::Vector3d(1.0, 2.0, 2.0) / 3.0);
  write_scan(scan);
  const Scan back = read_scan(folder.path());
  EXPECT_EQ(back.patterns[0].direction, FringeDirection::Horizontal);
  EXPECT_EQ(back.patterns[0].period_px, 20.0);
  EXPECT_EQ(back.patterns[0].exposures_ms, scan.patterns[0].exposures_ms);
  ASSERT_EQ(back.patterns[0].shifts_rad.size(), 3U);
  EXPECT_NEAR(back.patterns[0].shifts_rad[2], 2.0 * third_rad, 1e-12);
  EXPECT_EQ(back.patterns[1].bits, 8);
  EXPECT_EQ(back.patterns[1].stripe_px, 10.0);
  EXPECT_EQ(back.patterns[2].levels, scan.patterns[2].levels);
  EXPECT_EQ(back.views[0].setup, 0);
  EXPECT_EQ(back.views[1].setup, 1);
  EXPECT_NEAR(back.views[1].angle_rad, third_rad, 1e-12);
  EXPECT_TRUE(back.part_poses.at(1).isApprox(scan.part_poses.at(1), 1e-10));
}

TEST(WriteScan, WritesRoundNumbersAsPeopleDo) {
  const SmallFolder folder;
  Scan scan = read_scan(folder.path());
  scan.views[0].angle_rad = rad_from_deg(120.0);
  write_scan(scan);
  std::ifstream in(folder.path() / "scan.toml");
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  expect_names(text, "angle_deg = 120.0\n");
  expect_names(text, "version = 2\n");
}

TEST(ReadScanFault, ALinePatternNeedsAPlaneInTheRig) {
  const SmallFolder folder;
  Rig rig = read_rig(folder.path() / "rig.toml");
  rig.laser_sheet.reset();
  write_rig(folder.path() / "rig.toml", rig);
  expect_names(complaint(folder), "[line]");
}

TEST(ReadScanFault, AFolderThatIsNoScanIsNamed) {
  const TemporaryFolder empty;
  try {
    static_cast<void>(read_scan(empty.path()));
    FAIL();
  } catch (const Error& error) {
    expect_names(error.what(), "scan.toml");
  }
}

}  // namespace
}  // namespace frangia
