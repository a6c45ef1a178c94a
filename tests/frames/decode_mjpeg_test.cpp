#include "frangia/frames/decode_mjpeg.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "support/error_of.h"
#include "support/webcam_jpeg.h"

namespace frangia::mjpeg {
namespace {

constexpr int kWidth = 64;
constexpr int kHeight = 48;

std::uint8_t fringes(int x, int y) {
  return static_cast<std::uint8_t>(std::lround(120.0 + 80.0 * std::cos(0.3 * x + 0.05 * y)));
}

std::vector<std::uint8_t> frame(int quality = 85) {
  return testing::webcam_jpeg(kWidth, kHeight, quality, fringes);
}

TEST(DecodeMjpeg, ReadsFramesWithoutHuffmanTables) {
  for (const int quality : {50, 85, 95}) {
    const MjpegFrame decoded = decode_mjpeg(frame(quality), kWidth, kHeight);
    EXPECT_EQ(decoded.quality, quality);
    double square = 0.0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x)
        square += std::pow(decoded.brightness(x, y) - fringes(x, y), 2);
    }
    EXPECT_LT(std::sqrt(square / (kWidth * kHeight)), quality == 50 ? 4.0 : 2.0);
  }
}

TEST(DecodeMjpeg, SkipsStrayBytes) {
  std::vector<std::uint8_t> bytes = frame();
  bytes.insert(bytes.begin() + 2, {0x00, 0x00, 0x12});  // after the start of the image
  bytes.insert(bytes.end(), 100, 0x00);                 // padding of the buffer
  EXPECT_EQ(decode_mjpeg(bytes, kWidth, kHeight).quality, 85);
}

TEST(DecodeMjpeg, RefusesDamagedFramesAndOtherSizes) {
  const std::vector<std::uint8_t> bytes = frame();
  const auto error = [](const std::vector<std::uint8_t>& some, int width) {
    return testing::error_of([&] { static_cast<void>(decode_mjpeg(some, width, kHeight)); });
  };
  EXPECT_NE(error(bytes, kWidth + 8).find("has 64 x 48 pixels instead of 72 x 48"),
            std::string::npos);
  EXPECT_NE(error({bytes.begin(), bytes.begin() + std::ssize(bytes) / 2}, kWidth)
                .find("truncated or damaged"),
            std::string::npos);
  EXPECT_NE(error({0x12, 0x34, 0x56, 0x78}, kWidth).find("cannot be read"), std::string::npos);
  for (std::size_t i = 0; i < bytes.size(); ++i) {  // no damage to a byte crashes it
    std::vector<std::uint8_t> damaged = bytes;
    damaged[i] ^= 0xFF;
    try {
      static_cast<void>(decode_mjpeg(damaged, kWidth, kHeight));
    } catch (const Error&) {
    }
  }
}

}  // namespace
}  // namespace frangia::mjpeg
