#include <filesystem>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"

#include "support/error_of.h"
#include "support/temporary_folder.h"
#include "support/text_of.h"

namespace frangia {
namespace {

using testing::text_of;

TEST(AtomicFile, AppearsCompleteWhenCommitted) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "a.txt";
  AtomicFile file(path);
  file.stream() << "whole";
  EXPECT_FALSE(std::filesystem::exists(path));
  file.commit();
  EXPECT_EQ(text_of(path), "whole");
}

TEST(AtomicFile, KeepsTheOldFileAndLeavesNoTemporaryFileWhenNotCommitted) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "a.txt";
  std::ofstream(path) << "old";
  {
    AtomicFile file(path);
    file.stream() << "half";
  }
  EXPECT_EQ(text_of(path), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(AtomicFile, NamesAMissingFolder) {
  try {
    const AtomicFile file("/nowhere/a.txt");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::File);
    EXPECT_NE(std::string(error.what()).find("/nowhere/a.txt"), std::string::npos);
  }
}

TEST(AtomicFile, DoesNotCommitAfterAWriteError) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "a.txt";
  AtomicFile file(path);
  file.stream().setstate(std::ios::badbit);  // like a full disk
  EXPECT_THROW(file.commit(), Error);
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(AtomicFile, KeepsThePermissionsOfTheFileItReplaces) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "a.txt";
  for (const ::mode_t mode : {0600U, 0640U, 0664U}) {
    std::ofstream(path) << "old";
    ::chmod(path.c_str(), mode);
    AtomicFile file(path);
    file.stream() << "new";
    file.commit();
    struct ::stat state {};
    ::stat(path.c_str(), &state);
    EXPECT_EQ(state.st_mode & 0777U, mode);
  }
}

TEST(AtomicFile, LeavesAFileAloneThatHasAGuessedTemporaryName) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "a.txt";
  const auto victim = folder.path() / "victim.txt";
  std::ofstream(victim) << "precious";
  std::filesystem::create_symlink(victim, folder.path() / fmt::format(".a.txt.{}.tmp", ::getpid()));
  AtomicFile file(path);
  file.stream() << "new";
  file.commit();
  EXPECT_EQ(text_of(victim), "precious");
  EXPECT_EQ(text_of(path), "new");
}

TEST(AtomicFile, TwoWritersOfOneFileDoNotMix) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "a.txt";
  AtomicFile one(path);
  AtomicFile other(path);
  EXPECT_NE(one.temporary(), other.temporary());
  one.stream() << "one";
  other.stream() << "other";
  one.commit();
  EXPECT_EQ(text_of(path), "one");
  other.commit();
  EXPECT_EQ(text_of(path), "other");
}

TEST(AtomicFile, AcceptsANameAsLongAsTheFileSystemAllows) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / std::string(255, 'a');
  AtomicFile file(path);
  file.commit();
  EXPECT_TRUE(std::filesystem::exists(path));
}

TEST(AtomicFile, RefusesToReplaceANamedPipe) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  const std::string sentence = testing::error_of([&] { const AtomicFile file(path); });
  EXPECT_NE(sentence.find("named pipe"), std::string::npos) << sentence;
  EXPECT_TRUE(std::filesystem::is_fifo(path));
}

TEST(RemoveTemporaryFiles, RemovesOnlyThoseOfAtomicFileInAllSubfolders) {
  const testing::TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "views/000");
  const auto leave = [&](const std::string& name) { std::ofstream(folder.path() / name) << "x"; };
  {
    AtomicFile file(folder.path() / "views/000/fringe-0.png");
    std::filesystem::copy_file(file.temporary(), folder.path() / "kept");
    const std::string name = file.temporary().filename().string();
    EXPECT_TRUE(is_temporary_file_name(name)) << name;
    leave("views/000/" + name + "x");
    leave("views/000/.other.frangia-0123456789abcdef.tmp");
  }
  leave(".mine.123.tmp");
  leave("notes.tmp");
  leave(".vimrc.frangia-0123456789abcdeg.tmp");
  EXPECT_EQ(remove_temporary_files(folder.path()), 1U);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / ".mine.123.tmp"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "notes.tmp"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / ".vimrc.frangia-0123456789abcdeg.tmp"));
}

}  // namespace
}  // namespace frangia
