#include "frangia/service/project_folder.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/folder_lock.h"
#include "frangia/core/read_file.h"

#include "support/error_of.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::error_of;

TEST(ProjectLibrary, CreatesListsAndFindsProjects) {
  const testing::TemporaryFolder folder;
  const ProjectLibrary library(folder.path() / "deep" / "projects");
  EXPECT_TRUE(library.list().empty());
  const ProjectFolder made = library.create("Büste 1");
  ASSERT_EQ(library.list().size(), 1U);
  EXPECT_EQ(library.list()[0].name, "Büste 1");
  EXPECT_FALSE(library.list()[0].scanned);
  EXPECT_EQ(library.find("Büste 1").folder, made.folder);
  EXPECT_NE(error_of([&] { static_cast<void>(library.create("Büste 1")); }), "");
}

TEST(ProjectLibrary, MakesNoPathFromAName) {
  const testing::TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "outside");
  std::ofstream(folder.path() / "outside" / "project.json") << "{}";
  const ProjectLibrary library(folder.path() / "projects");
  static_cast<void>(library.create("inside"));
  std::filesystem::create_directory_symlink(folder.path() / "outside",
                                            folder.path() / "projects" / "link");
  for (const std::string name :
       {"../outside", "..", ".", "", "inside/../../outside", "link", "inside/", "/etc"})
    EXPECT_NE(error_of([&] { static_cast<void>(library.find(name)); }), "") << name;
  for (const auto& entry : library.list())
    EXPECT_EQ(entry.name, "inside");
}

TEST(ProjectLibrary, RenamesCopiesDeletesAndPutsBack) {
  const testing::TemporaryFolder folder;
  const ProjectLibrary library(folder.path());
  const ProjectFolder made = library.create("Part");
  std::filesystem::create_directories(made.folder / "versions" / "001");
  std::ofstream(made.folder / "versions" / "001" / "surface.ply") << "ply";
  std::filesystem::create_symlink("/etc/passwd", made.folder / "link");
  const auto inner = std::filesystem::path("versions") / "001" / "surface.ply";
  const auto old = std::filesystem::file_time_type::clock::now() - std::chrono::hours(48);
  std::filesystem::last_write_time(made.folder / inner, old);
  const auto names = [&] {
    std::vector<std::string> found;
    for (const ProjectEntry& one : library.list())
      found.push_back(one.name);
    std::sort(found.begin(), found.end());
    return found;
  };
  using Names = std::vector<std::string>;
  library.duplicate("Part", "Copy", {});
  EXPECT_EQ(names(), (Names{"Copy", "Part"}));
  EXPECT_EQ(modified_s(folder.path() / "Copy" / inner), modified_s(made.folder / inner));
  EXPECT_FALSE(
      std::filesystem::exists(std::filesystem::symlink_status(folder.path() / "Copy" / "link")));
  library.rename("Copy", "Other");
  EXPECT_EQ(names(), (Names{"Other", "Part"}));
  EXPECT_NE(error_of([&] { library.rename("Other", "Part"); }), "") << "the name is taken";
  EXPECT_NE(error_of([&] { library.rename("Other", "../out"); }), "");
  EXPECT_NE(error_of([&] { library.duplicate("Nothing", "New", {}); }), "");

  library.discard("Other");
  EXPECT_EQ(names(), Names{"Part"});
  EXPECT_EQ(library.discarded(), Names{"Other"});
  EXPECT_NE(error_of([&] { static_cast<void>(library.find(".bin")); }), "");
  static_cast<void>(library.create("Other"));
  EXPECT_EQ(library.take_back("Other"), "Other 2") << "the name was given to another one since";
  EXPECT_EQ(names(), (Names{"Other", "Other 2", "Part"}));
  EXPECT_NE(error_of([&] { static_cast<void>(library.take_back("../Part")); }), "");
}

TEST(ProjectLibrary, EmptiesItsBinAndNothingElse) {
  const testing::TemporaryFolder folder;
  const auto outside = folder.path() / "outside.txt";
  write_text_file(outside, "kept");
  const ProjectLibrary library(folder.path() / "projects");
  for (const char* name : {"A", "B", "C"}) {
    const ProjectFolder made = library.create(name);
    write_text_file(made.folder / "notes.txt", "12345");
    std::filesystem::create_symlink(outside, made.folder / "link");
    std::filesystem::create_directory_symlink(folder.path(), made.folder / "folder");
  }
  library.discard("A");
  library.discard("B");
  const auto size_of_a = library.in_bin().bytes / 2;
  EXPECT_GT(size_of_a, 5U);
  EXPECT_LT(size_of_a, 200U) << "links are not followed";
  EXPECT_NE(error_of([&] { library.empty_bin({"A", "C"}, {}); }), "") << "C is not in the bin";
  EXPECT_NE(error_of([&] { library.empty_bin({"../C"}, {}); }), "");
  EXPECT_NE(error_of([&] { library.empty_bin({".."}, {}); }), "");
  EXPECT_EQ(library.discarded().size(), 2U) << "nothing is deleted before all names are known";
  library.empty_bin({"A"}, {});
  EXPECT_EQ(library.discarded(), std::vector<std::string>{"B"});
  EXPECT_EQ(library.in_bin().bytes, size_of_a);
  // What an interrupted deletion left goes with the next one.
  std::filesystem::create_directories(library.bin() / ".deleted" / "rest");
  library.empty_bin({"B"}, {});
  EXPECT_TRUE(std::filesystem::is_empty(library.bin()));
  EXPECT_EQ(library.list().size(), 1U);
  EXPECT_EQ(read_text_file(outside), "kept");
  // Nothing is deleted through a link in place of the bin.
  std::filesystem::remove(library.bin());
  std::filesystem::create_directory_symlink(library.root(), library.bin());
  EXPECT_NE(error_of([&] { library.empty_bin({"C"}, {}); }), "");
  EXPECT_EQ(library.list().size(), 1U);
}

TEST(ProjectLibrary, LeavesAProjectThatSomebodyHasOpen) {
  const testing::TemporaryFolder folder;
  const ProjectLibrary library(folder.path());
  const ProjectFolder made = library.create("Part");
  const auto refused = [&] {
    std::vector<std::string> sentences;
    sentences.push_back(error_of([&] { library.discard("Part"); }));
    sentences.push_back(error_of([&] { library.rename("Part", "Other"); }));
    sentences.push_back(error_of([&] { library.duplicate("Part", "Copy", {}); }));
    return std::count_if(sentences.begin(), sentences.end(), [](const std::string& sentence) {
      return sentence.find("is writing to this folder") != std::string::npos;
    });
  };
  {
    const FolderLock open(made.derived);
    EXPECT_EQ(refused(), 3);
    // The process itself that has it open may copy it.
    library.duplicate("Part", "Mine", {}, true);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "Mine" / FolderLock::kFileName));
  }
  std::filesystem::create_directory(made.scan);
  {
    const FolderLock captures(made.scan);
    EXPECT_EQ(refused(), 3);
  }
  EXPECT_EQ(library.list().size(), 2U);
  EXPECT_EQ(error_of([&] { library.discard("Part"); }), "");
}

TEST(ProjectLibrary, ThrowsNothingOverALinkInPlaceOfTheBin) {
  const testing::TemporaryFolder folder;
  const testing::TemporaryFolder outside;
  const ProjectLibrary library(folder.path());
  static_cast<void>(library.create("Part"));
  std::filesystem::create_directories(outside.path() / "Secret");
  std::ofstream(outside.path() / "Secret" / "project.json") << "{}";
  std::filesystem::create_directory_symlink(outside.path(), folder.path() / ".bin");
  EXPECT_NE(error_of([&] { library.discard("Part"); }), "");
  EXPECT_EQ(library.list().size(), 1U);
  EXPECT_FALSE(std::filesystem::exists(outside.path() / "Part"));
  EXPECT_TRUE(library.discarded().empty());
  EXPECT_NE(error_of([&] { static_cast<void>(library.take_back("Secret")); }), "");
}

TEST(CheckProjectName, RefusesWhatIsNoPlainFileName) {
  const auto refusal = [](const std::string& name) {
    return error_of([&] { check_project_name(name); });
  };
  for (const std::string& name : {std::string(),
                                  std::string("."),
                                  std::string(".."),
                                  std::string("../x"),
                                  std::string("a/b"),
                                  std::string("a\\b"),
                                  std::string(".hidden"),
                                  std::string("-o"),
                                  std::string(" a"),
                                  std::string("a "),
                                  std::string("a\nb"),
                                  std::string("a\0b", 3),
                                  std::string(61, 'a')})
    EXPECT_NE(refusal(name), "") << name;
  for (const char* name : {"bust", "Bust 2 (red)", "Büste", "1"})
    EXPECT_EQ(refusal(name), "") << name;
}

TEST(ProjectIn, TakesAPlainScanFolder) {
  const testing::TemporaryFolder folder;
  EXPECT_NE(error_of([&] { static_cast<void>(project_in(folder.path())); }), "");
  std::ofstream(folder.path() / "scan.toml") << "";
  const ProjectFolder project = project_in(folder.path());
  EXPECT_EQ(project.scan, project.folder);
  EXPECT_EQ(project.derived, project.folder / "derived");
}

}  // namespace
}  // namespace frangia
