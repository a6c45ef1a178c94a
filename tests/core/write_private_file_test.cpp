#include <filesystem>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "frangia/core/durable_file.h"

#include "support/error_of.h"
#include "support/temporary_folder.h"
#include "support/text_of.h"

namespace frangia {
namespace {

TEST(WritePrivateFile, IsNeverReadableByOthers) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "secret";
  const ::mode_t before = ::umask(0);
  for (const char* text : {"one", "two"}) {  // the second one replaces a file that others may read
    write_private_file(path, text);
    struct ::stat state {};
    ::stat(path.c_str(), &state);
    EXPECT_EQ(state.st_mode & 0777U, 0600U);
    EXPECT_EQ(testing::text_of(path), text);
    ::chmod(path.c_str(), 0644);
  }
  ::umask(before);
}

TEST(WritePrivateFile, ReplacesALinkAndLeavesWhereItLeads) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "secret";
  write_private_file(folder.path() / "other", "kept");
  std::filesystem::create_symlink("other", path);
  write_private_file(path, "a secret");
  EXPECT_EQ(testing::text_of(folder.path() / "other"), "kept");
  EXPECT_EQ(testing::text_of(path), "a secret");
}

TEST(WritePrivateFile, NamesAMissingFolder) {
  const std::string sentence =
      testing::error_of([] { write_private_file("/nowhere/secret", "text"); });
  EXPECT_NE(sentence.find("/nowhere/secret"), std::string::npos) << sentence;
}

}  // namespace
}  // namespace frangia
