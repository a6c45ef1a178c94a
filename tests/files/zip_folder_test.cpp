#include "frangia/files/zip_folder.h"

#include <fstream>

#include <gtest/gtest.h>

#include "frangia/files/internal/zip_file.h"

#include "support/error_of.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::error_of;

TEST(ZipFolder, HoldsTheFilesOfAllSubfolders) {
  const testing::TemporaryFolder folder;
  const auto scan = folder.path() / "scan";
  std::filesystem::create_directories(scan / "views" / "000");
  const std::string large(300'000, 'f');
  std::ofstream(scan / "scan.toml") << "version = 2\n";
  std::ofstream(scan / "views" / "000" / "frame.png") << large;
  std::ofstream(scan / ".hidden") << "x";
  std::filesystem::create_symlink("/etc/passwd", scan / "link");
  const auto archive = folder.path() / "scan.zip";
  zip_folder(scan, "My part", archive);
  const ZipReader reader(archive);
  const auto read = [&](const std::string& name) {
    std::string text;
    const bool found = reader.read(name, [&](std::string_view piece, double) { text += piece; });
    return found ? text : "missing";
  };
  EXPECT_EQ(read("My part/scan.toml"), "version = 2\n");
  EXPECT_EQ(read("My part/views/000/frame.png"), large);
  EXPECT_EQ(read("My part/.hidden"), "missing");
  EXPECT_EQ(read("My part/link"), "missing");
}

TEST(UnzipFolder, TakesTheFolderOfItsMarkerAndNothingThatLeadsOut) {
  const testing::TemporaryFolder folder;
  const auto archive = folder.path() / "scan.zip";
  const auto write = [&](const std::vector<std::string>& names) {
    ZipWriter writer(archive);
    for (const std::string& name : names) {
      writer.begin(name);
      writer.text(name);
    }
    writer.commit();
  };
  const auto into = folder.path() / "into";
  const auto outside = folder.path() / "outside";
  write({"Part/scan.toml", "Part/views/000/a.png", "Part/.hidden", "beside.txt"});
  unzip_folder(archive, "scan.toml", into);
  EXPECT_TRUE(std::filesystem::is_regular_file(into / "scan.toml"));
  EXPECT_EQ(std::filesystem::file_size(into / "views" / "000" / "a.png"), 20U);
  EXPECT_FALSE(std::filesystem::exists(into / ".hidden"));
  EXPECT_FALSE(std::filesystem::exists(into / "beside.txt"));
  for (const std::vector<std::string>& bad : {std::vector<std::string>{"views/000/a.png"},
                                              {"a/scan.toml", "b/scan.toml"},
                                              {"scan.toml", "../outside"},
                                              {"scan.toml", "views/../../outside"},
                                              {"scan.toml", "/tmp/outside"},
                                              {"a/scan.toml", "a/" + outside.string()},
                                              {"scan.toml", "views\\..\\outside"}}) {
    write(bad);
    EXPECT_NE(error_of([&] { unzip_folder(archive, "scan.toml", folder.path() / "bad"); }), "")
        << bad.back();
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "bad"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "outside"));
  }
}

TEST(UnzipFolder, TakesTheOutermostFolderOfItsMarker) {
  const testing::TemporaryFolder folder;
  const auto archive = folder.path() / "scan.zip";
  {
    ZipWriter writer(archive);
    for (const std::string name : {"Part/capture/scan.toml", "Part/scan.toml", "scan.txt"}) {
      writer.begin(name);
      writer.text(name);
    }
    writer.commit();
  }
  const auto into = folder.path() / "into";
  unzip_folder(archive, "scan.toml", into);
  EXPECT_EQ(std::filesystem::file_size(into / "scan.toml"), 14U);
  EXPECT_EQ(std::filesystem::file_size(into / "capture" / "scan.toml"), 22U);
  EXPECT_FALSE(std::filesystem::exists(into / "scan.txt"));
}

TEST(UnzipFolder, ReadsLongNamesAndRefusesWhatExpandsTooFarAltogether) {
  const testing::TemporaryFolder folder;
  const auto archive = folder.path() / "scan.zip";
  const std::string deep = std::string(200, 'a') + "/" + std::string(200, 'b');
  {
    ZipWriter writer(archive);
    writer.begin("scan.toml");
    writer.begin(deep);
    writer.text("content");
    writer.commit();
  }
  unzip_folder(archive, "scan.toml", folder.path() / "into");
  EXPECT_EQ(std::filesystem::file_size(folder.path() / "into" / deep), 7U);

  constexpr int kParts = 3;  // none of them too large by itself
  const std::string zeros(std::size_t{30} << 20U, '\0');
  ZipWriter writer(archive);
  writer.begin("scan.toml");
  for (int i = 0; i < kParts; ++i) {
    writer.begin(std::to_string(i));
    writer.text(zeros);
  }
  writer.commit();
  ASSERT_LT(std::filesystem::file_size(archive), zeros.size() * kParts / 200);
  const std::string refusal =
      error_of([&] { unzip_folder(archive, "scan.toml", folder.path() / "bad"); });
  EXPECT_NE(refusal.find("altogether"), std::string::npos) << refusal;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "bad"));
}

TEST(ZipFolder, RefusesAFolderWithoutFiles) {
  const testing::TemporaryFolder folder;
  EXPECT_NE(error_of([&] { zip_folder(folder.path(), "x", folder.path() / "x.zip"); }), "");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "x.zip"));
}

}  // namespace
}  // namespace frangia
