// The library names options in backticks as snake_case; the program words them as flags.
#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "support/run_program.h"
#include "support/temporary_folder.h"
#include "support/text_of.h"

namespace frangia {
namespace {

using testing::Answer;
using testing::run_program;
using testing::text_of;

/// The source without comments, and with the parts of each string literal joined.
std::string code_of(const std::filesystem::path& path) {
  const std::string without_comments =
      std::regex_replace(text_of(path), std::regex(R"(//[^\n]*)"), "");
  return std::regex_replace(without_comments, std::regex(R"("\s*\n\s*")"), "");
}

std::set<std::string> flags_of_all_verbs() {
  std::string help = run_program("--help-all").output;
  for (const char* verb :
       {"board", "capture", "rig", "turntable", "refine", "import", "export", "piezo"})
    help += run_program(std::string("calibrate ") + verb + " --help").output;
  const std::regex flag("--([a-z][a-z0-9-]*)");
  std::set<std::string> flags;
  for (std::sregex_iterator i(help.begin(), help.end(), flag), end; i != end; ++i)
    flags.insert((*i)[1]);
  return flags;
}

TEST(OptionNames, EachBacktickedNameOfTheLibraryIsAnOptionOfAVerb) {
  const std::set<std::string> flags = flags_of_all_verbs();
  ASSERT_TRUE(flags.count("voxel") == 1 && flags.count("fill-holes") == 1);
  const std::regex name("`([a-z][a-z0-9_]*)`");
  int names = 0;
  const std::filesystem::path source = std::filesystem::path(FRANGIA_SOURCE_DIR) / "src";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source)) {
    if (!entry.is_regular_file()) continue;
    const std::string code = code_of(entry.path());
    for (std::sregex_iterator i(code.begin(), code.end(), name), end; i != end; ++i) {
      ++names;
      std::string flag =
          std::regex_replace((*i)[1].str(), std::regex("_(mm|px|rad|deg|ms|s)$"), "");
      std::replace(flag.begin(), flag.end(), '_', '-');
      EXPECT_EQ(flags.count(flag), 1U) << entry.path() << ": no verb has --" << flag;
    }
  }
  EXPECT_GT(names, 5);
}

TEST(OptionNames, TheLibraryWordsNoFlag) {
  const std::regex flag(R"("[^"\n]*--[a-z])");
  const std::filesystem::path source = std::filesystem::path(FRANGIA_SOURCE_DIR) / "src";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source)) {
    if (!entry.is_regular_file()) continue;
    const std::string code = code_of(entry.path());
    std::smatch found;
    EXPECT_FALSE(std::regex_search(code, found, flag)) << entry.path() << ": " << found.str();
  }
}

TEST(OptionNames, AnErrorNamesTheFlag) {
  const Answer answer = run_program("demo -o " + std::string(FRANGIA_SOURCE_DIR));
  EXPECT_EQ(answer.exit_code, 3);
  EXPECT_NE(answer.output.find("name a new or empty folder as --output"), std::string::npos)
      << answer.output;
}

}  // namespace
}  // namespace frangia
