#include "frangia/core/atomic_file.h"

#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "frangia/core/error.h"

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

}  // namespace
}  // namespace frangia
