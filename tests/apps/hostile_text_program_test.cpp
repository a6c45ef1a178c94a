// Names and keys with control characters, bytes that are not UTF-8, and an output that cannot be
// written.
#include <algorithm>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "frangia/files/ply.h"

#include "support/run_program.h"
#include "support/temporary_folder.h"
#include "support/test_meshes.h"

namespace frangia {
namespace {

using testing::Answer;
using testing::run_program;
using testing::run_shell;
using testing::TemporaryFolder;

std::string small_rig() {
  return FRANGIA_SOURCE_DIR "/tests/data/small-interferometer.toml";
}

/// Whether a terminal shows the text as it is: no control character but the end of lines, no
/// override of direction, and valid UTF-8.
bool is_plain(const std::string& text) {
  const bool controls = std::any_of(text.begin(), text.end(), [](char letter) {
    return (letter >= 0 && letter < ' ' && letter != '\n') || letter == '\x7f';
  });
  const bool valid =
      nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) ==
      nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::ignore);
  return !controls && valid && text.find("\u202e") == std::string::npos &&
         text.find("\u009b") == std::string::npos;
}

std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST(HostileText, ANameCannotControlTheTerminalOrForgeALine) {
  const Answer answer = run_shell(FRANGIA_PROGRAM
                                  " edit \"$(printf 'a\\033[31m\\nfrangia: all is "
                                  "well\\r\\302\\233\\342\\200\\256\\377.ply')\" --list");
  EXPECT_EQ(answer.exit_code, 3);
  EXPECT_TRUE(is_plain(answer.output)) << answer.output;
  EXPECT_EQ(lines_of(answer.output), 1U) << answer.output;
  EXPECT_NE(answer.output.find(R"(a\x1b[31m\nfrangia: all is well\r\u009b\u202e\xff.ply)"),
            std::string::npos)
      << answer.output;
}

TEST(HostileText, AKeyOfATomlFileCannotForgeALine) {
  const TemporaryFolder folder;
  const auto rig = folder.path() / "rig.toml";
  std::ifstream in(small_rig());
  std::ofstream(rig) << "\"a\\u001b]0;b\\u0007\\nwarning: forged\" = 1\n" << in.rdbuf();
  const Answer answer = run_program(fmt::format(
      "simulate plate --rig {} --views 1 -o {}", rig.string(), (folder.path() / "s").string()));
  EXPECT_EQ(answer.exit_code, 0) << answer.output;
  EXPECT_TRUE(is_plain(answer.output)) << answer.output;
  EXPECT_NE(answer.output.find(R"(a\x1b]0;b\x07\nwarning: forged is unknown)"), std::string::npos)
      << answer.output;
  EXPECT_EQ(answer.output.find("\nwarning: forged"), std::string::npos);
}

TEST(HostileText, ANameInATableCannotForgeALine) {
  const TemporaryFolder folder;
  write_ply(folder.path() / "a\x1b[31m\nforged.ply", testing::relief());
  const Answer answer = run_shell(fmt::format(
      "cd {} && {} merge a*forged.ply -o merged.ply", folder.path().string(), FRANGIA_PROGRAM));
  EXPECT_EQ(answer.exit_code, 0) << answer.output;
  EXPECT_TRUE(is_plain(answer.output)) << answer.output;
  EXPECT_NE(answer.output.find(R"(a\x1b[31m\nforged)"), std::string::npos) << answer.output;
  EXPECT_EQ(answer.output.find("\nforged"), std::string::npos) << answer.output;
}

TEST(HostileText, JsonIsValidWhateverTheNameOfAFile) {
  const TemporaryFolder folder;
  const Answer answer =
      run_shell(fmt::format("cd {} && {} --json simulate plate --rig {} --views 1 -o \"$(printf "
                            "'s\\377\\033\\177\\342\\200\\256')\" 2>/dev/null",
                            folder.path().string(),
                            FRANGIA_PROGRAM,
                            small_rig()));
  EXPECT_EQ(answer.exit_code, 0) << answer.output;
  EXPECT_TRUE(is_plain(answer.output)) << answer.output;
  const auto json = nlohmann::json::parse(answer.output, nullptr, false);
  ASSERT_TRUE(json.is_object()) << answer.output;
  EXPECT_EQ(json["scan"], "s\ufffd\x1b\x7f\u202e");
}

TEST(HostileText, AnOutputThatCannotBeWrittenIsAnError) {
  for (const char* arguments : {"algorithms",
                                "--json algorithms",
                                "algorithms --json",
                                "--help",
                                "--version",
                                "--help-all"}) {
    const Answer answer = run_shell(fmt::format("{} {} >/dev/full", FRANGIA_PROGRAM, arguments));
    EXPECT_EQ(answer.exit_code, 3) << arguments;
    EXPECT_NE(answer.output.find("standard output cannot be written"), std::string::npos)
        << arguments << ": " << answer.output;
  }
  EXPECT_EQ(run_shell(FRANGIA_PROGRAM " algorithms >/dev/null").exit_code, 0);
}

TEST(HostileText, AnOutputWithoutAReaderEndsTheProgramAsOthersEnd) {
  for (const char* arguments : {"--help-all", "algorithms", "--json algorithms"}) {
    const Answer answer = run_shell(
        fmt::format("{{ sleep 0.2; {} {}; echo $? >&2; }} | true", FRANGIA_PROGRAM, arguments));
    EXPECT_EQ(answer.output, "141\n") << arguments;
  }
}

TEST(HostileText, AnErrorKeepsItsExitCodeWhenStandardErrorCannotBeWritten) {
  const Answer answer = run_shell(FRANGIA_PROGRAM " edit missing.ply --list 2>/dev/full");
  EXPECT_EQ(answer.exit_code, 3) << answer.output;
}

}  // namespace
}  // namespace frangia
