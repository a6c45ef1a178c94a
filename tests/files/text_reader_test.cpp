#include "frangia/files/internal/text_reader.h"

#include <array>
#include <bit>
#include <charconv>
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "files/sample_meshes.h"

namespace frangia {
namespace {

TEST(TextReader, ReadsEveryNotationOfNumbers) {
  EXPECT_EQ(parse_float("+1.5e+01"), 15.0F);
  EXPECT_EQ(parse_float("-.5"), -0.5F);
  EXPECT_EQ(parse_float("1e-60"), 0.0F);
  EXPECT_TRUE(std::isinf(parse_float("1e60").value()));
  EXPECT_TRUE(std::isnan(parse_float("nan").value()));
  EXPECT_EQ(parse_integer("+7"), 7);
}

TEST(TextReader, ReadsEveryFloatBackFromItsShortestDigits) {
  EXPECT_TRUE(rc::check([](std::uint32_t bits) {
    const auto number = std::bit_cast<float>(bits);
    std::array<char, 32> text{};
    const auto* end = std::to_chars(text.data(), text.data() + text.size(), number).ptr;
    const std::optional<float> back =
        parse_float({text.data(), static_cast<std::size_t>(end - text.data())});
    RC_ASSERT(back && (*back == number || std::isnan(number)));
  }));
}

TEST(TextReader, RefusesWordsThatOnlyBeginWithANumber) {
  for (const char* word : {"", "+", "+-1", "1,5", "1.5mm", "0x10", "one"})
    EXPECT_FALSE(parse_float(word)) << word;
  for (const char* word : {"", "1.0", "99999999999999999999"})
    EXPECT_FALSE(parse_integer(word)) << word;
}

TEST(TextReader, SeparatesWordsAndLines) {
  TextReader reader("a.txt", "one  two\r\n\n three");
  EXPECT_EQ(reader.word_on_line(), "one");
  EXPECT_EQ(reader.word_on_line(), "two");
  EXPECT_EQ(reader.word_on_line(), "");
  EXPECT_EQ(reader.word(), "three");
  EXPECT_EQ(reader.word(), "");
}

TEST(TextReader, ReplacesControlCharactersInMessages) {
  TextReader reader("a.txt", "\n\x1b[2Jabcdefghijklmnopqrstuvwxyz 1");
  EXPECT_EQ(testing::error_of([&] { return reader.real(); }),
            "a.txt, line 2: '?[2Jabcdefghijklmnopqrst...' is not a number");
}

}  // namespace
}  // namespace frangia
