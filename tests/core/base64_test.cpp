#include "frangia/core/base64.h"

#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace frangia {
namespace {

TEST(Base64, AgreesWithTheVectorsOfRfc4648) {
  const std::vector<std::pair<std::string, std::string>> vectors = {{"", ""},
                                                                    {"f", "Zg=="},
                                                                    {"fo", "Zm8="},
                                                                    {"foo", "Zm9v"},
                                                                    {"foob", "Zm9vYg=="},
                                                                    {"fooba", "Zm9vYmE="},
                                                                    {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, letters] : vectors) {
    EXPECT_EQ(encode_base64(bytes), letters);
    EXPECT_EQ(decode_base64(letters), bytes);
  }
}

TEST(Base64, RestoresEveryByteAndHasEveryLetter) {
  std::string bytes;
  for (int i = 0; i < 256; ++i)
    bytes += static_cast<char>(i);
  EXPECT_EQ(decode_base64(encode_base64(bytes)), bytes);
  EXPECT_EQ(encode_base64("\xFB\xEF\xBE\xFF\xFF\xFF"), "++++////");
}

TEST(Base64, RefusesOtherCharacters) {
  for (const char* letters : {"Zm9-", "Zm 9", "Zm9\n", "Z=g=", "\xC3\xA4"})
    EXPECT_FALSE(decode_base64(letters)) << letters;
}

}  // namespace
}  // namespace frangia
