#include "frangia/dataset/import_frames.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stop_token>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "frangia/core/angles.h"
#include "frangia/core/error.h"
#include "frangia/dataset/read_frames.h"
#include "frangia/dataset/scan_folder.h"
#include "frangia/frames/float_tiff.h"
#include "frangia/frames/png.h"
#include "frangia/rig/read_rig.h"
#include "frangia/rig/rig_covariance.h"
#include "frangia/rig/write_rig.h"

#include "dataset/import_fixture.h"

namespace frangia {
namespace {

using testing::bytes_of;
using testing::error_of;

using ImportFrames = testing::ImportFixture;

std::filesystem::path image_path(const std::string& name) {
  return std::filesystem::path(FRANGIA_SOURCE_DIR) / "tests/data/images" / name;
}

TEST_F(ImportFrames, SortsFramesByPatternAndNumberWithoutChangingAPixel) {
  options_.projector_px = {1280, 800};
  options_.period_px.clear();
  options_.fringes = {{"p64", 64.0}, {"p8", 8.0}};
  options_.reverse_shifts = true;
  options_.origin_rad = rad_from_deg(-90.0);
  write_fringes("p64");
  write_fringes("p8", 3);
  const Scan scan = import();
  ASSERT_EQ(scan.patterns.size(), 2U);
  EXPECT_EQ(scan.patterns[0].name, "p8");  // numbers count in the order
  EXPECT_EQ(scan.patterns[1].period_px, 20.0);
  EXPECT_NEAR(scan.patterns[1].shifts_rad[1], rad_from_deg(-180.0), 1e-9);
  EXPECT_NEAR(scan.patterns[0].shifts_rad[1], rad_from_deg(-210.0), 1e-9);
  const auto stacks = read_frames(scan, 0);
  for (int k = 0; k < 4; ++k)
    EXPECT_EQ(counts_at(stacks[1].frames[static_cast<std::size_t>(k)], 7, 5), 10 * k + 3);
  EXPECT_EQ(counts_at(stacks[0].frames[2], 0, 0), 22);
  EXPECT_EQ(scan.rig.reference().model.width_px, 8);
  EXPECT_EQ(scan.rig.reference().white_level, 255);
}

TEST_F(ImportFrames, LeavesOutFramesThatAreSkippedAndFilesThatFitNothing) {
  for (int k = 0; k < 6; ++k)
    write(fmt::format("shot_{:02}.png", k), 10 * k);
  write("preview.png", 99);
  options_.names.clear();
  options_.skip = {0, 5};
  const ImportPlan plan = plan_import(images(), options_);
  EXPECT_EQ(plan.names, "shot_{frame:02}.png");
  ASSERT_EQ(plan.frames.size(), 4U);
  EXPECT_EQ(plan.frames.front().file.filename(), "shot_01.png");
  EXPECT_EQ(plan.left_out.size(), 2U);
  options_.skip = {0, 1, 2, 3};
  expect_complaint("has 2 frames; a phase needs at least 3");
}

TEST_F(ImportFrames, TakesFoldersOfPatternsAndFramesInTheOrderOfTheirTimes) {
  for (const char* pattern : {"coarse", "fine"}) {
    std::filesystem::create_directories(images() / "run" / pattern);
    for (const auto& [time, value] :
         {std::pair{"12-59-58.9", 0}, {"12-59-59.4", 1}, {"13-00-00.1", 2}, {"13-00-00.7", 3}})
      write(fmt::format("run/{}/{}.png", pattern, time), value);
  }
  options_.names.clear();
  options_.period_px = {{"coarse", 80.0}, {"fine", 20.0}};
  const ImportPlan plan = plan_import(images(), options_);
  EXPECT_EQ(plan.names, "run/{pattern}/{*}-{*}-{*}.{*}.png");
  ASSERT_EQ(plan.frames.size(), 8U);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_EQ(plan.frames[k].frame, k);
  EXPECT_EQ(plan.frames[3].file.filename(), "13-00-00.7.png");
}

TEST_F(ImportFrames, TakesTheBoardOfAFileOfPatterns) {
  write_fringes("p");
  const auto file = images() / "patterns.toml";
  std::ofstream(file) << "[[pattern]]\nname = \"p\"\nkind = \"fringe\"\nperiod_px = 20\n"
                         "shifts_deg = [0, 90, 180, 270]\n"
                         "[board]\nkind = \"checkerboard\"\ncorners = [10, 7]\nsquare_mm = 15\n";
  options_.patterns = file;
  options_.period_px.clear();
  options_.projector_px = ProjectorSize{640, 480};
  const Scan scan = import();
  ASSERT_TRUE(scan.board);
  EXPECT_EQ(scan.board->columns, 10);
}

TEST_F(ImportFrames, PutsEachCamerasFramesIntoAFolderOfItsName) {
  options_.names = "{camera}/{pattern}_{frame:02}.png";
  options_.projector_px = {1280, 800};
  for (int k = 0; k < 4; ++k) {
    std::filesystem::create_directories(images() / "left");
    std::filesystem::create_directories(images() / "right");
    write(fmt::format("left/a_{:02}.png", k), 10 + k);
    write<std::uint16_t>(fmt::format("right/a_{:02}.png", k), 100 + k, 10, 4);
  }
  expect_complaint("frames of a scan have one depth");
  for (int k = 0; k < 4; ++k)
    write(fmt::format("right/a_{:02}.png", k), 100 + k, 10, 4);
  const Scan scan = import();
  ASSERT_EQ(scan.rig.cameras.size(), 2U);
  EXPECT_EQ(scan.rig.cameras.at(1).camera.name, "right");
  EXPECT_EQ(scan.rig.cameras.at(1).camera.model.width_px, 10);
  EXPECT_TRUE(scan.rig.projector.is_label);
  EXPECT_EQ(counts_at(read_frames(scan, 0)[0].frames[2], 0, 0), 12);
  EXPECT_EQ(counts_at(read_frames(scan_of_camera(scan, 1), 0)[0].frames[3], 9, 3), 103);
}

TEST_F(ImportFrames, RefusesCamerasThatDoNotFitEachOther) {
  options_.names = "{camera}_{frame}.png";
  for (int k = 0; k < 4; ++k) {
    write(fmt::format("l_{}.png", k), 10 + k);
    if (k < 3) write(fmt::format("r_{}.png", k), 10 + k);
  }
  expect_complaint("the patterns have 4 frames, but 3 were found, r_0.png to r_2.png");
  options_.reference = "middle";
  expect_complaint("`reference` is \"middle\", but the cameras are l, r");
}

TEST_F(ImportFrames, KeepsTheColorOfAWhiteFrameBesideGreyFringes) {
  options_.projector_px = {1280, 800};
  write_fringes("a");
  Image<Rgb> picture(8, 6, Rgb{10, 100, 200});
  picture(3, 2) = {255, 0, 51};
  write_png(images() / "white_00.png", picture);
  write("black_00.png", 5);
  const Scan scan = import();
  ASSERT_EQ(scan.patterns.size(), 3U);
  EXPECT_EQ(scan.patterns[1].kind, PatternKind::Ambient);
  EXPECT_EQ(scan.patterns[2].kind, PatternKind::White);
  EXPECT_EQ(scan.rig.reference().white_level, 255);
  const auto stacks = read_frames(scan, 0);
  EXPECT_TRUE(stacks[1].color.empty());
  ASSERT_EQ(stacks[2].color.width(), 8);
  EXPECT_TRUE(stacks[2].color(3, 2).isApprox(Eigen::Vector3f(1.0F, 0.0F, 0.2F)));
  // ITU-R BT.601: 0.299 R + 0.587 G + 0.114 B.
  EXPECT_EQ(counts_at(stacks[2].frames[0], 3, 2), 82);
  EXPECT_EQ(counts_at(stacks[2].frames[0], 0, 0), 84);
}

TEST_F(ImportFrames, DemosaicsAWhiteFrame) {
  options_.projector_px = {1280, 800};
  options_.color = parse_color_choice("demosaic:RGGB");
  write_fringes("a");
  Image<std::uint8_t> mosaic(8, 6);
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 8; ++x)
      mosaic(x, y) = y % 2 == 0 && x % 2 == 0 ? 51 : (x + y) % 2 == 1 ? 102 : 153;
  }
  write_png(images() / "white_00.png", Frame(std::move(mosaic)));
  const auto stacks = read_frames(import(), 0);
  for (const int x : {0, 3, 7}) {
    EXPECT_TRUE(stacks[1].color(x, 4).isApprox(Eigen::Vector3f(0.2F, 0.4F, 0.6F)))
        << stacks[1].color(x, 4).transpose();
  }
}

TEST_F(ImportFrames, TakesTheCovarianceOfACalibratedRigAlong) {
  Rig rig = rig_of_images();
  rig.calibration = Calibration{.date = "2026-01-01", .board = "checkerboard", .poses = 12};
  rig.calibration->covariance_file = "rig-covariance.csv";
  rig.calibration->covariance.parameters = {"camera.focal_px"};
  rig.calibration->covariance.covariance = Eigen::MatrixXd::Constant(1, 1, 0.25);
  options_.rig = images().parent_path() / "rig.toml";
  write_rig(options_.rig, rig);
  write_fringes("a");
  const Scan scan = import();
  EXPECT_EQ(read_rig(scan.folder / "rig.toml").calibration->covariance.covariance(0, 0), 0.25);
}

TEST_F(ImportFrames, RecordsEachOriginalWithItsChecksum) {
  options_.projector_px = {1280, 800};
  options_.names = "{frame}.bmp";
  for (int k = 0; k < 3; ++k)
    std::filesystem::copy_file(image_path("grey8.bmp"), images() / fmt::format("{}.bmp", k + 1));
  static_cast<void>(import());
  const auto record = nlohmann::json::parse(bytes_of(target() / "import.json"));
  ASSERT_EQ(record["frames"].size(), 3U);
  EXPECT_EQ(record["frames"][1]["original"], "2.bmp");
  EXPECT_EQ(record["frames"][1]["file"], "views/000/fringes-1-1.png");
  EXPECT_EQ(record["frames"][1]["codec"], "bmp");
  // Printed by: python3 -c "import zlib; print('%08x' % zlib.crc32(open('grey8.bmp','rb').read()))"
  EXPECT_EQ(record["frames"][1]["crc32"], "d6f30f09");
}

TEST_F(ImportFrames, TakesTheImagesOfAStackAsFrames) {
  options_.projector_px = {1280, 800};
  options_.names = "";
  const ImportPlan plan = plan_import(image_path("pages.tiff"), options_);
  EXPECT_EQ(plan.frames.size(), 3U);
  static_cast<void>(import_frames(plan, target()));
  const Scan scan = read_scan(target(), {}, RigContent::StartValues);
  EXPECT_EQ(counts_at(read_frames(scan, 0)[0].frames[1], 3, 2), 255 - 77);
}

TEST_F(ImportFrames, KeepsFloatingPointFramesAndScalesThemWhenTheyAreRead) {
  options_.projector_px = {1280, 800};
  options_.names = "{frame}.tiff";
  for (int k = 0; k < 3; ++k)
    std::filesystem::copy_file(image_path("float.tiff"), images() / fmt::format("{}.tiff", k));
  const Scan scan = import();
  EXPECT_TRUE(scan.frames.is_float);
  EXPECT_EQ(scan.frames.full_scale, 1.0);
  EXPECT_EQ(scan.rig.reference().white_level, 65535);
  const ImageFile kept(target() / "views/000/fringes-1-0.tiff");
  const ImageFile original(image_path("float.tiff"));
  const auto pixels = [](const ImageFile& file) {
    const RasterImage image = file.read();
    const auto values = std::get<Image<float>>(image.samples).pixels();
    return std::vector<float>(values.begin(), values.end());
  };
  EXPECT_EQ(pixels(kept), pixels(original));
  EXPECT_EQ(counts_at(read_frames(scan, 0)[0].frames[0], 3, 2), 257 * 77);
}

TEST_F(ImportFrames, FindsTheWhiteLevelOf16BitFrames) {
  options_.projector_px = {1280, 800};
  for (int k = 0; k < 3; ++k)
    write<std::uint16_t>(fmt::format("a_{:02}.png", k), 1000 + 1000 * k);
  EXPECT_EQ(import().rig.reference().white_level, 4095);
  std::filesystem::remove_all(target());
  for (int k = 0; k < 3; ++k)  // 12 bits, shifted to the left
    write<std::uint16_t>(fmt::format("a_{:02}.png", k), (1001 + 1000 * k) * 16);
  EXPECT_EQ(import().rig.reference().white_level, 65520);
}

TEST_F(ImportFrames, StatesTheVarianceOfAJpeg) {
  options_.projector_px = {1280, 800};
  options_.names = "{frame}.jpg";
  for (int k = 0; k < 3; ++k)
    std::filesystem::copy_file(image_path("grey.jpg"), images() / fmt::format("{}.jpg", k));
  const Scan scan = import();
  EXPECT_NEAR(scan.frames.compression_counts2, 0.05 + 12.0 * std::pow(0.3, 1.5), 1e-9);
  EXPECT_EQ(read_frames(scan, 0)[0].compression_counts2, scan.frames.compression_counts2);
}

TEST_F(ImportFrames, NumbersTheViewsAndTakesBlackImagesAsAmbient) {
  options_ = {};
  options_.layout = "3dunderworld";
  options_.names = "v{view}/{frame:04}.png";
  options_.projector_px = {4, 2};
  options_.angles_rad = {0.0, 1.5};
  for (const char* view : {"v7", "v9"}) {
    std::filesystem::create_directories(images() / view);
    for (int k = 0; k < 8; ++k)
      write(fmt::format("{}/{:04}.png", view, k), k);
  }
  const Scan scan = import();
  ASSERT_EQ(scan.views.size(), 2U);
  EXPECT_NEAR(scan.views[1].angle_rad, 1.5, 1e-9);
  EXPECT_EQ(scan.patterns[1].bits, 2);
  const auto stacks = read_frames(scan, 1);
  EXPECT_EQ(counts_at(stacks[0].frames[0], 0, 0), 0);  // white is the first image
  EXPECT_EQ(counts_at(stacks[2].frames[1], 0, 0), 7);  // the last inverse of the rows
  EXPECT_EQ(stacks[3].pattern.kind, PatternKind::Ambient);
  EXPECT_EQ(counts_at(stacks[3].frames[0], 0, 0), 1);
}

TEST_F(ImportFrames, WritesTheCameraAloneWhereNothingElseIsKnown) {
  write_fringes("a");
  static_cast<void>(import_frames(plan_import(images(), options_), target()));
  EXPECT_EQ(bytes_of(target() / "rig.toml"),
            "format = \"frangia-rig\"\nversion = 1\n\n[camera]\nsize_px = [8, 6]\nwhite_level = "
            "255\n");
}

TEST_F(ImportFrames, DoesNotWaitForAPipeInThePlaceOfASize) {
  write_fringes("a");
  ASSERT_EQ(::mkfifo((images() / "projector_info.txt").c_str(), 0600), 0);
  expect_complaint("projector_info.txt: this is not a regular file");
}

TEST_F(ImportFrames, RefusesWhatIsIncompleteOrAmbiguous) {
  options_.names = "{pattern}-{frame}.png";
  write_fringes("a");
  expect_complaint("the template \"{pattern}-{frame}.png\" fits none of 4 files, such as a_00.png");
  options_.names = "{pattern}_{frame}.png";
  write("a_0.png", 1);
  expect_complaint("a_00.png are the same frame by the template");
  std::filesystem::remove(images() / "a_0.png");
  std::filesystem::remove(images() / "a_01.png");
  expect_complaint("pattern \"a\": frame number 1 is missing before");
  write_fringes("a", 2);
  std::filesystem::remove(images() / "a_03.png");
  std::filesystem::remove(images() / "a_02.png");
  expect_complaint("pattern \"a\" has 2 frames; a phase needs at least 3");
}

TEST_F(ImportFrames, RefusesFramesOfSeveralKinds) {
  write_fringes("a");
  write("a_02.png", 9, 8, 7);
  expect_complaint("a_02.png has 8 x 7 pixels, 8 bits, but");
  write<std::uint16_t>("a_02.png", 9);
  expect_complaint("a_02.png has 8 x 6 pixels, 16 bits, but");
  options_.names = "color8.{pattern}";
  std::filesystem::copy_file(image_path("color8.png"), images() / "color8.png");
  expect_complaint("color8.png: is a colour image; set `color` to red, green, blue or luminance");
}

TEST_F(ImportFrames, RefusesADescriptionThatDoesNotFit) {
  write_fringes("a");
  options_.period_px.clear();
  expect_complaint("the patterns are not described; set `fringes`");
  options_.fringes = {{"", 64.0}};
  expect_complaint("set `projector`, such as 1280x800");
  options_.projector_px = {1280, 800};
  options_.shifts_rad = {0.0, 1.0, 2.0};
  expect_complaint("pattern \"a\" has 4 frames, but `shifts` lists 3");
  options_.shifts_rad.clear();
  options_.fringes = {{"b", 64.0}};
  expect_complaint("no file shows the pattern \"b\"");
  options_.patterns = images() / "patterns.toml";
  std::ofstream(options_.patterns)
      << "[[pattern]]\nname = \"a\"\nkind = \"fringe\"\nperiod_px = 20\n"
         "shifts_deg = [0, 120, 240]\n";
  expect_complaint("pattern \"a\" has 3 frames, but 4 were found, a_00.png to a_03.png");
  options_.angles_rad = {0.0, 1.0};
  expect_complaint("`angles` lists 2, but the folder has 1 view;");
}

TEST_F(ImportFrames, LeavesNothingWhenItIsStoppedOrAFrameIsDamaged) {
  write_fringes("a", 12);
  const ImportPlan plan = plan_import(images(), options_);
  std::stop_source source;
  frangia::Run run;
  run.stop = source.get_token();
  run.progress = [&](double done) {
    if (done > 0.5) source.request_stop();
  };
  EXPECT_EQ(error_of([&] { import_frames(plan, target(), run); }), "stopped by the user");
  EXPECT_TRUE(std::filesystem::is_empty(target().parent_path()));
  const std::string bytes = bytes_of(images() / "a_11.png");
  std::ofstream(images() / "a_11.png", std::ios::binary) << bytes.substr(0, bytes.size() / 2);
  expect_complaint("a_11.png: is truncated or damaged");
}

TEST_F(ImportFrames, RefusesATargetThatExists) {
  write_fringes("a");
  std::filesystem::create_directories(target());
  std::ofstream(target() / "mine.txt") << "keep";
  const std::string error =
      error_of([&] { import_frames(plan_import(images(), options_), target()); });
  EXPECT_NE(error.find("exists already; remove it or choose another name"), std::string::npos);
  EXPECT_EQ(bytes_of(target() / "mine.txt"), "keep");
}

}  // namespace
}  // namespace frangia
