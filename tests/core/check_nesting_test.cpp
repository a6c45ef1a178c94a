#include "frangia/core/check_nesting.h"

#include <string>

#include <gtest/gtest.h>

#include "support/error_of.h"

namespace frangia {
namespace {

using testing::error_of;

std::string repeated(const std::string& part, int count) {
  std::string all;
  for (int i = 0; i < count; ++i)
    all += part;
  return all;
}

std::string json_fault(const std::string& text) {
  return error_of([&] { check_json_nesting(text, "a.json"); });
}

std::string toml_fault(const std::string& text) {
  return error_of([&] { check_toml_nesting(text, "a.toml"); });
}

TEST(CheckNesting, RefusesDeepJsonAndNamesTheLine) {
  EXPECT_EQ(json_fault("\n\n" + repeated("[", 100'000)),
            "a.json: line 3: brackets are nested more than 100 deep; correct the file");
  EXPECT_NE(json_fault(repeated("{\"a\":", 101)), "");
  EXPECT_EQ(json_fault(repeated("[", 100) + repeated("]", 100)), "");
  EXPECT_EQ(json_fault(repeated("[],", 100'000)), "");
}

TEST(CheckNesting, CountsNoBracketOfAString) {
  EXPECT_EQ(json_fault("\"" + repeated("[\\\"", 1000) + "\""), "");
  EXPECT_EQ(toml_fault("a = \"" + repeated("[\\\"", 1000) + "\""), "");
  EXPECT_EQ(toml_fault("a = '" + repeated("[.", 1000) + "'"), "");
  EXPECT_EQ(toml_fault("a = '''\n" + repeated("[.\n'", 1000) + "'''"), "");
  EXPECT_EQ(toml_fault("a = \"\"\"\n" + repeated("[.\n\"", 1000) + "\"\"\""), "");
  EXPECT_EQ(toml_fault("# " + repeated("[a.", 1000) + "\na = 1"), "");
}

TEST(CheckNesting, CountsAfterAStringOfSeveralLinesThatEndsWithItsOwnQuotes) {
  for (const std::string text : {R"("""b"""")", R"("""b""""")", "'''b''''", "'''b'''''"}) {
    EXPECT_NE(toml_fault("a = [" + text + ", " + repeated("[", 100)), "") << text;
    EXPECT_NE(toml_fault("a = {b = " + text + ", a" + repeated(".a", 100) + " = 1}"), "") << text;
    EXPECT_EQ(toml_fault("a = [" + text + ", \"" + repeated("[", 1000) + "\"]"), "") << text;
  }
}

TEST(CheckNesting, RefusesDeepToml) {
  EXPECT_EQ(toml_fault("a = " + repeated("[", 100'000)),
            "a.toml: line 1: brackets are nested more than 100 deep; correct the file");
  EXPECT_NE(toml_fault("a = " + repeated("{a=", 101)), "");
  EXPECT_EQ(toml_fault("a = \"b\" # [\n" + repeated("[[view]]\nx = [1, 2]\n", 1000)), "");
}

TEST(CheckNesting, RefusesAKeyOfManyPartsButNotManyNumbers) {
  EXPECT_EQ(toml_fault("a" + repeated(".a", 100'000) + " = 1"),
            "a.toml: line 1: a key has more than 100 dotted parts; correct the file");
  EXPECT_NE(toml_fault("[a" + repeated(" . \"a\"", 100) + "]"), "");
  EXPECT_NE(toml_fault("b = {a" + repeated(".a", 100) + " = 1}"), "");
  EXPECT_EQ(toml_fault("a = [" + repeated("1.5, ", 1000) + "]\n" + repeated("a.b = 1\n", 1000)),
            "");
}

}  // namespace
}  // namespace frangia
