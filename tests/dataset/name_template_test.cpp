#include "frangia/dataset/name_template.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/error_of.h"

namespace frangia {
namespace {

using testing::error_of;

TEST(NameTemplate, ReadsPatternFrameAndView) {
  const NameTemplate names("view{view:03}/{pattern}_{frame:02}.bmp");
  EXPECT_EQ(names.depth(), 1);
  const auto readings = names.match("view012/p_64_07.BMP");
  ASSERT_EQ(readings.size(), 1U);
  EXPECT_EQ(readings[0], (NameFields{"p_64", 7, 12}));
  EXPECT_TRUE(names.match("view12/p_07.bmp").empty());    // %03 writes 012
  EXPECT_TRUE(names.match("view012/p_7.bmp").empty());    // %02 writes 07
  EXPECT_TRUE(names.match("view012/p_007.bmp").empty());  // %02 writes 07
  EXPECT_TRUE(names.match("view012/p_07.png").empty());
}

TEST(NameTemplate, ReadsLongerNumbersAsPrintfWritesThem) {
  const NameTemplate names("{frame:02}.png");
  ASSERT_EQ(names.match("107.png").size(), 1U);
  EXPECT_EQ(names.match("107.png")[0].frame, 107);
  EXPECT_EQ(NameTemplate("{frame}.png").match("0107.png")[0].frame, 107);
}

TEST(NameTemplate, PrefersTheStatedWidthAndTheKnownPatterns) {
  const NameTemplate names("{pattern}{frame:02}.png");
  ASSERT_EQ(names.match("p6401.png").size(), 1U);
  EXPECT_EQ(names.match("p6401.png")[0], (NameFields{"p64", 1, {}}));
  const NameTemplate open("{pattern}{frame}.png");
  EXPECT_EQ(open.match("p6401.png").size(), 4U);
  ASSERT_EQ(open.match("p6401.png", {"p64", "p8"}).size(), 1U);
  EXPECT_EQ(open.match("p6401.png", {"p64", "p8"})[0].frame, 1);
}

TEST(NameTemplate, WritesBracesTwice) {
  EXPECT_EQ(NameTemplate("{{a}}{frame}").match("{a}5").at(0).frame, 5);
}

TEST(NameTemplate, RefusesWhatIsNoTemplate) {
  const auto complaint = [](const std::string& text) {
    return error_of([&] { NameTemplate{text}; });
  };
  EXPECT_NE(complaint("{shot}.png").find("{shot} is unknown"), std::string::npos);
  EXPECT_NE(complaint("{frame}{frame}").find("{frame} occurs twice"), std::string::npos);
  EXPECT_NE(complaint("{frame:x}").find("no valid width"), std::string::npos);
  EXPECT_NE(complaint("{frame").find("has no }"), std::string::npos);
  EXPECT_NE(complaint("frame}").find("has no {"), std::string::npos);
  EXPECT_FALSE(complaint("").empty());
}

TEST(GuessNameTemplate, FindsTheUsualForms) {
  EXPECT_EQ(guess_name_template({"cam_01.png", "cam_02.png", "cam_10.png"}), "cam_{frame:02}.png");
  EXPECT_EQ(guess_name_template({"frameSeq_0.bmp", "frameSeq_10.bmp"}), "frameSeq_{frame}.bmp");
  EXPECT_EQ(guess_name_template({"a_0.bmp", "a_1.bmp", "b_0.bmp"}), "{pattern}_{frame}.bmp");
  EXPECT_EQ(guess_name_template({"p64-00.png", "p64-01.png", "p8-00.png"}),
            "{pattern}-{frame:02}.png");
  EXPECT_EQ(guess_name_template({"v00/1.png", "v00/2.png", "v01/1.png", "v01/2.png"}),
            "v{view:02}/{frame}.png");
  EXPECT_EQ(guess_name_template({"left/a_0.png", "left/a_1.png", "right/a_0.png"}),
            "{camera}/a_{frame}.png");
  EXPECT_EQ(guess_name_template({"stack.tif"}), "stack.tif");
  EXPECT_EQ(guess_name_template({"coarse.tif", "fine.tif"}), "{pattern}.tif");  // of several pages
  EXPECT_EQ(guess_name_template({"coarse.npy", "fine.npy"}), "{pattern}.npy");
  EXPECT_EQ(guess_name_template({"shot0", "shot1"}), "shot{frame}");  // raw files
}

TEST(GuessNameTemplate, TakesFoldersOfPatternsAndTwoLevelsOfThem) {
  EXPECT_EQ(guess_name_template({"coarse/0.png", "coarse/1.png", "fine/0.png", "fine/1.png"}),
            "{pattern}/{frame}.png");
  EXPECT_EQ(guess_name_template({"p8/0.png", "p8/1.png", "p64-a/0.png", "p64-a/1.png"}),
            "{pattern}/{frame}.png");
  EXPECT_EQ(guess_name_template({"fringes8/0.png", "fringes8/1.png", "fringes64/0.png"}),
            "{pattern}/{frame}.png");
  EXPECT_EQ(guess_name_template(
                {"run 1/v0/a_0.png", "run 1/v0/b_0.png", "run 1/v1/a_0.png", "run 1/v1/b_0.png"}),
            "run 1/v{view}/{pattern}_{frame}.png");
  EXPECT_EQ(guess_name_template({"left/fine/0.png", "left/coarse/0.png", "right/fine/0.png"}),
            "{camera}/{pattern}/{frame}.png");
}

TEST(GuessNameTemplate, TellsTheNumberOfAFrameFromItsTime) {
  EXPECT_EQ(guess_name_template({"f_000_20240501T123059.100.png",
                                 "f_001_20240501T123100.204.png",
                                 "f_002_20240501T123100.311.png"}),
            "f_{frame:03}_20240501T{*}.{*}.png");
  EXPECT_EQ(guess_name_template({"2024-05-01_12-30-50_0 (1).png",
                                 "2024-05-01_12-30-51_1 (1).png",
                                 "2024-05-01_12-30-52_2 (1).png"}),
            "2024-05-01_12-30-{*}_{frame} (1).png");
  EXPECT_EQ(guess_name_template({"12-59-58.310.png", "12-59-59.001.png", "13-00-00.415.png"}),
            "{*}-{*}-{*}.{*}.png");
}

TEST(GuessNameTemplate, LooksPastAnOddName) {
  EXPECT_EQ(guess_name_template({"a_0.png", "a_1.png", "a_2.png", "a_3.png", "preview.png"}),
            "a_{frame}.png");
}

TEST(NameTemplate, PassesOverAnyText) {
  const NameTemplate timed("f_{frame:02}_{*}.png");
  const auto readings = timed.match("f_07_2024-05-01.png");
  ASSERT_EQ(readings.size(), 1U);
  EXPECT_EQ(readings[0].frame, 7);
  EXPECT_TRUE(timed.match("f_07_.png").empty());
}

TEST(GuessNameTemplate, RefusesNamesThatShowNothing) {
  const std::string error = error_of([] {
    static_cast<void>(guess_name_template({"left.png", "right.png"}));
  });
  EXPECT_NE(error.find("set `names` to a template"), std::string::npos) << error;
  EXPECT_FALSE(error_of([] {
                 static_cast<void>(guess_name_template({"a1.png", "b1_final.png"}));
               }).empty());
}

TEST(NaturalOrder, ComparesNumbersByTheirValue) {
  std::vector<std::string> names = {"p10", "p9", "p09b", "a", "p9a", "p1"};
  std::sort(names.begin(), names.end(), is_before_in_natural_order);
  EXPECT_EQ(names, (std::vector<std::string>{"a", "p1", "p9", "p9a", "p09b", "p10"}));
}

}  // namespace
}  // namespace frangia
