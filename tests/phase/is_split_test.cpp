#include <vector>

#include <gtest/gtest.h>

#include "frangia/core/missing.h"
#include "frangia/phase/internal/jumpless_regions.h"

namespace frangia {
namespace {

constexpr double kNotMeasured = static_cast<double>(kMissing);

/// A line of pixels at `left` of the field, then at `right`.
std::vector<double> line_of(double left, double right, std::size_t beside = 6) {
  std::vector<double> places(beside, left);
  places.insert(places.end(), beside, right);
  return places;
}

TEST(IsSplit, IsTrueWhereTheEndsOfTheFieldMeet) {
  EXPECT_TRUE(is_split(line_of(0.99, 0.01)));
  EXPECT_TRUE(is_split(line_of(0.01, 0.99)));
  EXPECT_TRUE(is_split(line_of(1.02, 0.01)));
  EXPECT_FALSE(is_split(line_of(0.94, 0.01))) << "a depth edge";
  EXPECT_FALSE(is_split(line_of(1.07, 0.01)));
  EXPECT_FALSE(is_split(line_of(0.5, 0.5)));
}

TEST(IsSplit, NeedsASurfaceOnBothSides) {
  EXPECT_FALSE(is_split(line_of(0.99, 0.01, 5))) << "five pixels beside the two are needed";
  std::vector<double> places = line_of(0.99, 0.01);
  places[0] = 0.75;
  EXPECT_FALSE(is_split(places));
  places[0] = 0.85;
  EXPECT_TRUE(is_split(places));
  places[11] = 0.25;
  EXPECT_FALSE(is_split(places));
  places[11] = kNotMeasured;
  EXPECT_FALSE(is_split(places));
}

TEST(IsSplit, LooksAtTheWholeLine) {
  for (std::size_t at = 0; at < 30; ++at) {
    std::vector<double> places(30, 0.5);
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (i + 6 >= at && i < at) places[i] = 0.99;
      if (i >= at && i < at + 6) places[i] = 0.01;
    }
    EXPECT_EQ(is_split(places), at >= 6 && at <= 24) << at;
  }
  EXPECT_FALSE(is_split({}));
}

}  // namespace
}  // namespace frangia
