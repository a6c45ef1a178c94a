#include "frangia/core/parse_length.h"

#include <string>

#include <gtest/gtest.h>

#include "frangia/core/error.h"

namespace frangia {
namespace {

TEST(ParseLength, ConvertsEachUnitToMillimetres) {
  EXPECT_DOUBLE_EQ(parse_length_mm("1mm"), 1.0);
  EXPECT_DOUBLE_EQ(parse_length_mm("0.5in"), 12.7);
  EXPECT_DOUBLE_EQ(parse_length_mm("2cm"), 20.0);
  EXPECT_DOUBLE_EQ(parse_length_mm("3um"), 0.003);
  EXPECT_DOUBLE_EQ(parse_length_mm("3\u00B5m"), 0.003);
  EXPECT_DOUBLE_EQ(parse_length_mm("3\u03BCm"), 0.003);
  EXPECT_DOUBLE_EQ(parse_length_mm("0.01m"), 10.0);
}

TEST(ParseLength, TakesANumberWithoutUnitAsMillimetres) {
  EXPECT_DOUBLE_EQ(parse_length_mm("25"), 25.0);
  EXPECT_DOUBLE_EQ(parse_length_mm("1e-3"), 0.001);
  EXPECT_DOUBLE_EQ(parse_length_mm("0"), 0.0);
}

TEST(ParseLength, KeepsTheSign) {
  EXPECT_DOUBLE_EQ(parse_length_mm("-3mm"), -3.0);
  EXPECT_DOUBLE_EQ(parse_length_mm("-0.5in"), -12.7);
}

TEST(ParseLength, IgnoresSpacesAroundNumberAndUnit) {
  EXPECT_DOUBLE_EQ(parse_length_mm(" 2 cm "), 20.0);
}

TEST(ParseLength, RefusesWhatIsNoFiniteLengthAndShowsIt) {
  for (const char* text : {"",      " ",     "mm",    "ten",    "1km",    "1 m m", "1mmm",  "1MM",
                           "1,5mm", "--1mm", "1deg",  "0x10",   "in",     "nan",   "nanmm", "inf",
                           "-inf",  "infm",  "1e400", "1e308m", "1e-400", "1mm 2"}) {
    try {
      const double length_mm = parse_length_mm(text);
      ADD_FAILURE() << "'" << text << "' became " << length_mm;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::Input);
      EXPECT_EQ(std::string(error.what()).find("'" + std::string(text) + "'"), 0U) << error.what();
    }
  }
}

}  // namespace
}  // namespace frangia
