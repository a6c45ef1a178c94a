#include <cstring>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "frangia/service/live_preview.h"

namespace frangia {
namespace {

/// The picture of a frame of one row.
std::vector<int> picture_of(const std::vector<std::uint16_t>& counts, int white_level) {
  Image<std::uint16_t> row(static_cast<int>(counts.size()), 1);
  std::copy(counts.begin(), counts.end(), row.pixels().begin());
  LiveSnapshot snapshot;
  snapshot.white_level = white_level;
  snapshot.frame = std::make_shared<const Frame>(std::move(row));
  const std::string packed = encode_live(snapshot, LiveLayer::Camera, Rig{});
  std::uint32_t length = 0;
  std::memcpy(&length, packed.data(), sizeof length);
  const auto header = nlohmann::json::parse(packed.substr(sizeof length, length));
  for (const auto& array : header.at("arrays")) {
    if (array.at("name") != "picture") continue;
    const auto begin = array.at("offset").get<std::size_t>();
    std::vector<int> bytes;
    for (std::size_t i = 0; i < counts.size(); ++i)
      bytes.push_back(static_cast<unsigned char>(packed.at(begin + i)));
    return bytes;
  }
  return {};
}

// Linear light and its sRGB byte, from the table of IEC 61966-2-1: 0.2140 is half of the range.
TEST(EncodeLive, ShowsLinearLightByTheCurveOfSrgb) {
  const auto bytes = picture_of({0, 41, 876, 2048, 4094, 4095, 5000}, 4095);
  ASSERT_EQ(bytes.size(), 7U);
  EXPECT_EQ(bytes[0], 0);
  EXPECT_NEAR(bytes[1], 25, 1) << "a hundredth of white";
  EXPECT_NEAR(bytes[2], 127, 1);
  EXPECT_NEAR(bytes[3], 187, 1);
  EXPECT_EQ(bytes[4], 254) << "not saturated";
  EXPECT_EQ(bytes[5], 255);
  EXPECT_EQ(bytes[6], 255);
}

}  // namespace
}  // namespace frangia
