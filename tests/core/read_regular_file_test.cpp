#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "frangia/core/read_file.h"

#include "support/error_of.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

std::string complaint(const std::filesystem::path& path, std::size_t max_bytes = SIZE_MAX) {
  return testing::error_of([&] { static_cast<void>(read_regular_file(path, max_bytes)); });
}

bool ends_with_kind(const std::string& sentence, const std::string& kind) {
  return sentence.find("is " + kind + ", not a file") != std::string::npos;
}

TEST(ReadRegularFile, ReturnsAllBytes) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "a";
  std::ofstream(path, std::ios::binary) << std::string("a\0b\n", 4);
  const auto bytes = read_regular_file(path);
  EXPECT_EQ(std::string(bytes.begin(), bytes.end()), std::string("a\0b\n", 4));
}

TEST(ReadRegularFile, RefusesPipesDevicesAndFoldersByTheirKindWithoutWaiting) {
  const testing::TemporaryFolder folder;
  const auto pipe = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_TRUE(ends_with_kind(complaint(pipe), "a named pipe")) << complaint(pipe);
  EXPECT_TRUE(ends_with_kind(complaint("/dev/zero"), "a device")) << complaint("/dev/zero");
  EXPECT_TRUE(ends_with_kind(complaint(folder.path()), "a folder"));
}

TEST(ReadRegularFile, RefusesANameWithANulCharacter) {
  const testing::TemporaryFolder folder;
  std::ofstream(folder.path() / "a") << "x";
  const auto path = folder.path() / std::string("a\0.png", 6);
  EXPECT_NE(complaint(path).find("NUL"), std::string::npos) << complaint(path);
}

TEST(ReadRegularFile, RefusesALargerFileBeforeReadingIt) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "sparse";
  std::ofstream(path) << "x";
  std::filesystem::resize_file(path, std::uintmax_t{1} << 40U);
  EXPECT_NE(complaint(path, 1000).find("1000 bytes"), std::string::npos);
}

}  // namespace
}  // namespace frangia
