#include "frangia/core/open_below.h"

#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "support/error_of.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

namespace fs = std::filesystem;
using testing::error_of;

class OpenBelow : public ::testing::Test {
 protected:
  OpenBelow() {
    fs::create_directories(folder_ / "a" / "b");
    fs::create_directories(outside_);
    std::ofstream(folder_ / "a" / "b" / "file") << "inside";
    std::ofstream(outside_ / "file") << "a secret";
  }

  [[nodiscard]] std::string refusal_of(const fs::path& inner) const {
    const std::string opened = error_of([&] { static_cast<void>(open_below(folder_, inner)); });
    const std::string appended =
        error_of([&] { static_cast<void>(open_below(folder_, inner, OpenFor::Appending)); });
    EXPECT_EQ(opened, appended);
    EXPECT_EQ(error_of([&] { static_cast<void>(path_below(folder_, inner)); }), opened);
    return opened;
  }

  testing::TemporaryFolder temporary_;
  fs::path folder_ = temporary_.path() / "project";
  fs::path outside_ = temporary_.path() / "outside";
};

TEST_F(OpenBelow, ReadsAFileBelow) {
  EXPECT_EQ(read_below(folder_, "a/b/file", 100), "inside");
  EXPECT_EQ(read_below(folder_, "./a//b/./file", 100), "inside");
  EXPECT_EQ(path_below(folder_, "a/b/file"), folder_ / "a" / "b" / "file");
  EXPECT_EQ(path_below(folder_, "./a//b/./file").string(), (folder_ / "a" / "b" / "file").string());
  EXPECT_EQ(path_below(folder_, "a/new/file"), folder_ / "a" / "new" / "file");
  fs::create_directory_symlink(folder_, temporary_.path() / "link");
  EXPECT_EQ(read_below(temporary_.path() / "link", "a/b/file", 100), "inside")
      << "the folder itself is named by the user";
}

TEST_F(OpenBelow, NamesALinkAtEveryPlaceOfThePathAndWhereItLeads) {
  fs::create_directory_symlink(outside_, folder_ / "a" / "linked");
  fs::create_directory_symlink("b", folder_ / "a" / "within");
  fs::create_symlink(outside_ / "file", folder_ / "a" / "b" / "linked-file");
  fs::create_symlink("nowhere", folder_ / "dangling");
  for (const char* inner : {"a/linked/file", "a/within/file", "a/b/linked-file", "dangling"}) {
    const std::string sentence = refusal_of(inner);
    EXPECT_NE(sentence.find("is a link to "), std::string::npos) << inner << ": " << sentence;
    EXPECT_NE(sentence.find("bind-mount"), std::string::npos) << sentence;
  }
  EXPECT_NE(refusal_of("a/linked/file").find((folder_ / "a" / "linked").string() + ": "),
            std::string::npos)
      << "the component that is the link";
  EXPECT_NE(refusal_of("a/linked/file").find(outside_.string()), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "nowhere")) << "appending creates nothing through a link";
}

TEST_F(OpenBelow, RefusesNamesThatLeadOut) {
  for (const std::string& inner : {std::string("../outside/file"),
                                   std::string("a/../../outside/file"),
                                   std::string("a/.."),
                                   (outside_ / "file").string(),
                                   std::string("a/b/file\0x", 10),
                                   std::string(),
                                   std::string(".")})
    EXPECT_NE(refusal_of(inner), "") << inner;
}

TEST_F(OpenBelow, RefusesWhatItCannotLookAt) {
  fs::create_directory_symlink(outside_, folder_ / "a" / "linked");
  rlimit usual{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &usual), 0);
  rlimit none = usual;
  none.rlim_cur = 0;  // no more files can be opened
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &none), 0);
  const std::string sentence =
      error_of([&] { static_cast<void>(path_below(folder_, "a/linked/file")); });
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &usual), 0);
  EXPECT_NE(sentence.find("Too many open files"), std::string::npos) << sentence;
}

TEST_F(OpenBelow, AppendsAndCreates) {
  for (const char* text : {"one", "two"}) {
    const FileDescriptor file = open_below(folder_, "a/new", OpenFor::Appending);
    ASSERT_EQ(::write(file.number(), text, 3), 3);
  }
  EXPECT_EQ(read_below(folder_, "a/new", 100), "onetwo");
  fs::create_hard_link(outside_ / "file", folder_ / "hard");
  EXPECT_NE(error_of([&] {
              static_cast<void>(open_below(folder_, "hard", OpenFor::Appending));
            }).find("a hard link"),
            std::string::npos);
  EXPECT_EQ(read_below(folder_, "hard", 100), "a secret");
}

TEST_F(OpenBelow, NamesWhatIsMissingTooLargeOrNoFileWithoutWaiting) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  const auto complaint = [&](const char* inner, std::uint64_t most) {
    return error_of([&] { static_cast<void>(read_below(folder_, inner, most)); });
  };
  EXPECT_NE(complaint("pipe", 10).find("is a named pipe"), std::string::npos);
  EXPECT_NE(complaint("a", 10).find("is a folder"), std::string::npos);
  EXPECT_NE(complaint("a/none", 10).find("does not exist"), std::string::npos);
  EXPECT_NE(complaint("a/b/file/none", 10).find("does not exist"), std::string::npos);
  EXPECT_NE(complaint("a/b/file", 5).find("6 bytes"), std::string::npos);
}

}  // namespace
}  // namespace frangia
