#include "frangia/dataset/scan_folder.h"

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "frangia/dataset/read_frames.h"
#include "frangia/frames/png.h"
#include "frangia/rig/read_rig.h"
#include "frangia/rig/write_rig.h"

#include "support/error_of.h"
#include "support/small_folder.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::expect_names;
using testing::SmallFolder;
using testing::TemporaryFolder;

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

TEST(ReadScanFault, AMissingFrameIsNamed) {
  const SmallFolder folder;
  std::filesystem::remove(folder.view() / "fringe-2.png");
  expect_names(complaint(folder), "fringe-2.png");
}

TEST(ReadScanFault, ASurplusFrameIsNamed) {
  const SmallFolder folder;
  for (const char* surplus : {"fringe-4.png", "fringe-4294967296.png", "fringe-99999999999.png"}) {
    const auto file = folder.view() / surplus;
    std::filesystem::copy_file(folder.view() / "fringe-2.png", file);
    expect_names(complaint(folder), surplus);
    std::filesystem::remove(file);
  }
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

TEST(ReadScanFault, AFrameThatIsNoFileIsRefusedAtOnceByItsKind) {
  const SmallFolder folder;
  const auto path = folder.view() / "fringe-2.png";
  std::filesystem::remove(path);
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  expect_names(complaint(folder), "fringe-2.png: is a named pipe, not a file");
  std::filesystem::remove(path);
  std::filesystem::create_directory(path);
  expect_names(complaint(folder), "fringe-2.png: is a folder, not a file");
}

TEST(ReadScanFault, AFrameThatIsALinkOutOfTheScanIsNamed) {
  const SmallFolder folder;
  const TemporaryFolder outside;
  const auto path = folder.view() / "fringe-2.png";
  std::filesystem::rename(path, outside.path() / "fringe-2.png");
  std::filesystem::create_symlink(outside.path() / "fringe-2.png", path);
  expect_names(complaint(folder), "fringe-2.png: is a link to " + outside.path().string());
  expect_names(complaint(folder), "put the files themselves here");
}

TEST(ReadScanFault, AFrameThatIsALinkInsideTheScanIsNamed) {
  const SmallFolder folder;
  const auto path = folder.view() / "fringe-2.png";
  std::filesystem::remove(path);
  std::filesystem::create_symlink("fringe-1.png", path);
  expect_names(complaint(folder), "fringe-2.png: is a link to fringe-1.png");
}

TEST(ReadScanFault, ARecordOfTheFramesThatIsALinkIsNamed) {
  const SmallFolder folder;
  const TemporaryFolder outside;
  std::ofstream(outside.path() / "manifest.txt") << "frame views/000/fringe-0.png 00000000\n";
  std::filesystem::create_directory_symlink(outside.path(), folder.path() / "capture");
  const auto fault_of = [&](const auto& read) {
    return testing::error_of([&] { static_cast<void>(read(folder.path())); });
  };
  expect_names(fault_of(read_stored_frames), "capture: is a link to " + outside.path().string());
  expect_names(fault_of(read_began_s), "capture: is a link to " + outside.path().string());
}

TEST(ReadScanFault, AFileOfTheScanThatIsALinkIsNamed) {
  for (const char* name : {"scan.toml", "rig.toml"}) {
    const SmallFolder folder;
    const TemporaryFolder outside;
    std::filesystem::rename(folder.path() / name, outside.path() / name);
    std::filesystem::create_symlink(outside.path() / name, folder.path() / name);
    expect_names(complaint(folder),
                 std::string(name) + ": is a link to " + outside.path().string());
  }
}

TEST(ReadScanFault, AFrameOfAnotherSizeIsRefusedBeforeItIsDecoded) {
  const SmallFolder folder;
  const auto path = folder.view() / "fringe-1.png";
  write_png(path, Frame(Image<std::uint8_t>(1300, 1000, 80)));
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  expect_names(complaint(folder), "1300 x 1000");
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
    ::testing::Values(
        Fault{"[0, 90, 180, 270]", "[0, 90]", "pattern[0].shifts_deg"},
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
        Fault{"folder = \"views/000\"", R"(folder = "views/000\u0000/x")", "inside"},
        Fault{"name = \"line\"", R"(name = "li\nne")", "pattern[1].name"},
        Fault{"name = \"line\"", R"(name = "li\u001bne")", "pattern[1].name"},
        Fault{"name = \"line\"", R"(name = "line\u0000x")", "pattern[1].name"},
        Fault{"angle_deg", "round = 1\nangle_deg", "is called setup now"},
        Fault{"[[view]]", "[[round]]\nround = 1\n[[view]]", "is called [[setup]] now"},
        Fault{"[[view]]", "[[setup]]\nround = 1\n[[view]]", "is called number now"},
        Fault{"[[view]]",
              "[[setup]]\nnumber = 1\nshift_mm = [0, 0, 1]\n[[view]]",
              "is called translation_mm now"},
        Fault{"version = 1", "version = 3", "reads versions up to 2"},
        Fault{"[[view]]", "[targets]\n[[view]]", "size of the targets is unknown"},
        Fault{"[[view]]", "[targets]\ndiameter_mm = 0\n[[view]]", "above 0"},
        Fault{"[[view]]", "[targets]\ndictionary = \"DICT_4X4_50\"\n[[view]]", "give marker_mm"},
        Fault{"[[view]]",
              "[targets]\ndictionary = \"DICT_9X9_50\"\nmarker_mm = 8\n[[view]]",
              "\"DICT_9X9_50\" is unknown"},
        Fault{"[[view]]", "[targets]\ndiameter_mm = 4\ndisc = \"black\"\n[[view]]", "targets.disc"},
        Fault{"[[view]]",
              "[targets]\ndictionary = \"DICT_4X4_50\"\nmarker_mm = 8\n"
              "[[targets.distance]]\nfrom = 1\nto = 60\ndistance_mm = 9\n"
              "sigma_mm = 0.1\n[[view]]",
              "has the codes 0 to 49"},
        Fault{"[[view]]", "[[vue]]", "[[view]]"}));

TEST(ReadScanFault, AFolderOfTwoViewsIsNamed) {
  const SmallFolder folder;
  std::ofstream(folder.path() / "scan.toml", std::ios::app)
      << "\n[[view]]\nangle_deg = 90.0\nfolder = \"views/./000\"\n";
  expect_names(complaint(folder), "has the folder \"views/./000\" twice");
}

TEST(ReadScanFault, AViewsFolderThatIsALinkOutOfTheScanIsNamed) {
  const SmallFolder folder;
  const TemporaryFolder outside;
  std::filesystem::remove_all(folder.view());
  std::filesystem::create_directory_symlink(outside.path(), folder.view());
  expect_names(complaint(folder), folder.view().string() + ": is a link to ");
  expect_names(complaint(folder), "bind-mount");
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
                         ::testing::Values(std::pair{"capture", "`frangia scan`"},
                                           std::pair{"simulation-not-finished",
                                                     "`frangia simulate`"}));

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
