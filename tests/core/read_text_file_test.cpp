#include <chrono>
#include <fstream>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "frangia/core/read_file.h"

#include "support/error_of.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::error_of;

TEST(ReadTextFile, RefusesWhatIsNoRegularFileAtOnce) {
  const testing::TemporaryFolder folder;
  const auto pipe = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const std::filesystem::path& path :
       {pipe, folder.path(), std::filesystem::path("/dev/zero")})
    EXPECT_NE(error_of([&] { return read_text_file(path); }).find("not a regular file"),
              std::string::npos)
        << path;
  EXPECT_NE(error_of([&] { return read_text_file(folder.path() / "a"); }).find("no such file"),
            std::string::npos);
}

TEST(ReadTextFile, RefusesALargeFileWithoutReadingIt) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "a.toml";
  std::ofstream(path) << "format = 1";
  EXPECT_EQ(read_text_file(path), "format = 1");
  std::filesystem::resize_file(path, 1'000'000'000'000);
  EXPECT_NE(error_of([&] { return read_text_file(path); }).find("has 1000000000000 bytes"),
            std::string::npos);
}

}  // namespace
}  // namespace frangia
