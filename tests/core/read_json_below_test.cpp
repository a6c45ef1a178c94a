#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "frangia/core/open_below.h"

#include "support/error_of.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

class ReadJsonBelow : public ::testing::Test {
 protected:
  [[nodiscard]] std::string refusal_of(const std::string& text) const {
    std::ofstream(folder_.path() / "a.json", std::ios::binary) << text;
    return testing::error_of([&] { static_cast<void>(read_json_below(folder_.path(), "a.json")); });
  }
  testing::TemporaryFolder folder_;
};

TEST_F(ReadJsonBelow, ReturnsTheTextAsItIs) {
  EXPECT_EQ(refusal_of("{\"a\": [1, 2]}\n"), "");
  EXPECT_EQ(read_json_below(folder_.path(), "a.json"), "{\"a\": [1, 2]}\n");
}

TEST_F(ReadJsonBelow, RefusesWhatAParserCannotBear) {
  EXPECT_NE(refusal_of(std::string(500'000, '[')).find("nested more than"), std::string::npos);
  EXPECT_NE(refusal_of(std::string(1'000'001, ' ')).find("1000001 bytes"), std::string::npos);
}

TEST_F(ReadJsonBelow, CountsTheValuesOfALargerFile) {
  std::string text = "[0";
  for (int i = 0; i < 1'000'000; ++i)
    text += ",0";
  std::ofstream(folder_.path() / "a.json", std::ios::binary) << text << ']';
  const std::string refusal = testing::error_of(
      [&] { static_cast<void>(read_json_below(folder_.path(), "a.json", 4'000'000)); });
  EXPECT_NE(refusal.find("more than 1000000 values"), std::string::npos) << refusal;
}

TEST_F(ReadJsonBelow, FollowsNoLink) {
  std::ofstream(folder_.path() / "b.json") << "{}";
  std::filesystem::create_symlink("b.json", folder_.path() / "a.json");
  const std::string refusal =
      testing::error_of([&] { static_cast<void>(read_json_below(folder_.path(), "a.json")); });
  EXPECT_NE(refusal.find("is a link to b.json"), std::string::npos) << refusal;
}

}  // namespace
}  // namespace frangia
