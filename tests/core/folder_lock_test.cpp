#include "frangia/core/folder_lock.h"

#include <array>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "support/error_of.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::error_of;

std::string refusal(const std::filesystem::path& folder) {
  return error_of([&] { const FolderLock lock(folder); });
}

/// A process that locks a folder and waits to be killed.
class LockingProcess {
 public:
  explicit LockingProcess(const std::filesystem::path& folder) {
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0) return;
    id_ = ::fork();
    if (id_ == 0) {
      const FolderLock lock(folder);
      static_cast<void>(!::write(ends[1], "x", 1));
      for (;;)
        ::pause();
    }
    char byte = 0;
    static_cast<void>(!::read(ends[0], &byte, 1));
    ::close(ends[0]);
    ::close(ends[1]);
  }
  LockingProcess(const LockingProcess&) = delete;
  LockingProcess& operator=(const LockingProcess&) = delete;
  LockingProcess(LockingProcess&&) = delete;
  LockingProcess& operator=(LockingProcess&&) = delete;
  ~LockingProcess() { kill(); }

  void kill() {
    if (id_ <= 0) return;
    ::kill(id_, SIGKILL);
    ::waitpid(id_, nullptr, 0);
    id_ = 0;
  }
  [[nodiscard]] ::pid_t id() const { return id_; }

 private:
  ::pid_t id_ = 0;
};

TEST(FolderLock, RefusesASecondWriterAndNamesFolderAndProcess) {
  const testing::TemporaryFolder folder;
  const LockingProcess other(folder.path());
  const std::string sentence = refusal(folder.path());
  EXPECT_NE(sentence.find(folder.path().string()), std::string::npos) << sentence;
  EXPECT_NE(sentence.find(fmt::format("process {} on ", other.id())), std::string::npos)
      << sentence;
}

TEST(FolderLock, RefusesASecondWriterInTheSameProcessAndOverALink) {
  const testing::TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "scan");
  std::filesystem::create_directory_symlink(folder.path() / "scan", folder.path() / "link");
  const FolderLock lock(folder.path() / "scan/");
  EXPECT_FALSE(refusal(folder.path() / "link").empty());
  EXPECT_TRUE(refusal(folder.path() / "other").empty());
}

TEST(FolderLock, ChangesNoFileOfAnotherName) {
  const testing::TemporaryFolder folder;
  std::ofstream(folder.path() / "work") << "somebody's";
  std::filesystem::create_directory(folder.path() / "scan");
  std::filesystem::create_hard_link(folder.path() / "work",
                                    folder.path() / "scan" / FolderLock::kFileName);
  EXPECT_NE(refusal(folder.path() / "scan").find("a hard link"), std::string::npos);
  std::string text;
  std::getline(std::ifstream(folder.path() / "work"), text);
  EXPECT_EQ(text, "somebody's");
}

TEST(FolderLock, OfAKilledProcessIsTakenOver) {
  const testing::TemporaryFolder folder;
  LockingProcess other(folder.path());
  other.kill();
  EXPECT_TRUE(std::filesystem::exists(folder.path() / FolderLock::kFileName));
  EXPECT_EQ(refusal(folder.path()), "");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / FolderLock::kFileName));
}

TEST(FolderLock, CreatesTheFolderAndRemovesItWhenItIsStillEmpty) {
  const testing::TemporaryFolder folder;
  { const FolderLock lock(folder.path() / "a/b/"); }
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "a"));
  {
    const FolderLock lock(folder.path() / "a/b");
    std::ofstream(folder.path() / "a/b/file") << "x";
  }
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "a/b/file"));
}

TEST(FolderLock, DoesNotRemoveAnEmptyFolderThatExistedBefore) {
  const testing::TemporaryFolder folder;
  { const FolderLock lock(folder.path()); }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace frangia
