#include <cstring>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "frangia/service/live_preview.h"

namespace frangia {
namespace {

nlohmann::json values_of(const LiveSnapshot& snapshot) {
  const std::string packed = encode_live(snapshot, LiveLayer::Camera, Rig{});
  std::uint32_t length = 0;
  std::memcpy(&length, packed.data(), sizeof length);
  return nlohmann::json::parse(packed.substr(sizeof length, length)).at("values");
}

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

// A part of 4 by 4 pixels in a dark room of 10 by 10: one pixel of the part in sixteen is dark.
TEST(EncodeLive, CountsTheDarkPixelsOfThePartAlone) {
  Image<std::uint16_t> frame(10, 10, 0);
  LiveDecode decode;
  decode.range.depth_mm = Image<float>(10, 10, std::numeric_limits<float>::quiet_NaN());
  for (int y = 3; y < 7; ++y) {
    for (int x = 2; x < 6; ++x) {
      frame(x, y) = 2000;
      decode.range.depth_mm(x, y) = 500.0F;
    }
  }
  frame(4, 5) = 3;  // too dark to be measured
  decode.range.depth_mm(4, 5) = std::numeric_limits<float>::quiet_NaN();
  decode.points = 15;
  LiveSnapshot snapshot;
  snapshot.white_level = 4095;
  snapshot.frame = std::make_shared<const Frame>(std::move(frame));
  EXPECT_DOUBLE_EQ(values_of(snapshot).at("dark").get<double>(), 0.85) << "no part is known";
  snapshot.decode = std::make_shared<const LiveDecode>(std::move(decode));
  EXPECT_DOUBLE_EQ(values_of(snapshot).at("dark").get<double>(), 1.0 / 16.0);
}

}  // namespace
}  // namespace frangia
