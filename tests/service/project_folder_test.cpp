#include "frangia/service/project_folder.h"

#include <fstream>

#include <gtest/gtest.h>

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
