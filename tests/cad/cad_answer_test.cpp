// What the second process says is checked as a file is.
#include "frangia/cad/internal/cad_answer.h"

#include <gtest/gtest.h>

#include "frangia/core/random.h"

namespace frangia {
namespace {

std::string answer_of(const CadTranslation& said, const std::string& shape) {
  std::string all;
  EXPECT_TRUE(send_answer(said, shape, [&](std::string_view bytes) {
    all += bytes;
    return true;
  }));
  return all;
}

TEST(CadAnswer, ArrivesAsItWasSent) {
  const auto found = parsed_answer(answer_of({{}, "inch", {"one", "two"}}, "the shape"));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->said.unit, "inch");
  EXPECT_EQ(found->said.warnings, (std::vector<std::string>{"one", "two"}));
  EXPECT_EQ(found->said.error, "");
  EXPECT_EQ(found->shape.str(), "the shape");
  const auto refused = parsed_answer(answer_of({"it is empty", "", {}}, ""));
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->said.error, "it is empty");
}

TEST(CadAnswer, HoldsNoControlCharactersAndNoLongTexts) {
  const CadTranslation hostile{
      {}, "\x1b[31minch\n", std::vector<std::string>(1000, std::string(5000, 'x'))};
  const auto found = parsed_answer(answer_of(hostile, "s"));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->said.unit, "?[31minch?");
  EXPECT_EQ(found->said.warnings.size(), 20U);
  EXPECT_EQ(found->said.warnings.front().size(), 300U);
}

TEST(CadAnswer, IsRefusedWhenItIsCutShortOrGoesOn) {
  const std::string sound = answer_of({{}, "inch", {"one"}}, "the shape");
  for (std::size_t size = 0; size < sound.size(); ++size)
    EXPECT_FALSE(parsed_answer(sound.substr(0, size))) << size;
  EXPECT_FALSE(parsed_answer(sound + sound));
  EXPECT_FALSE(parsed_answer(sound + "z"));
}

/// The sizes in the bytes come from another process.
TEST(CadAnswer, NeverReadsBeyondItsEnd) {
  const std::string sound = answer_of({{}, "inch", {"one"}}, std::string(100, 's'));
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    std::string damaged = sound;
    for (std::uint64_t k = 0; k <= i % 4; ++k)
      damaged[hash(i, 2 * k) % damaged.size()] = static_cast<char>(hash(i, 2 * k + 1) % 256);
    if (const auto found = parsed_answer(damaged)) {
      EXPECT_LE(found->shape.str().size(), 100U);
      EXPECT_LE(found->said.unit.size() + found->said.error.size(), 600U);
    }
  }
}

}  // namespace
}  // namespace frangia
