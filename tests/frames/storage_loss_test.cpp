// Losses of the storage leave traces in files that keep every bit.
#include "frangia/frames/storage_loss.h"

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "frangia/frames/decode_mjpeg.h"
#include "frangia/frames/jpeg_noise.h"

#include "support/webcam_jpeg.h"

namespace frangia {
namespace {

constexpr int kWidth = 360;
constexpr int kHeight = 280;

/// Fringes on a disc before a dark room, by a camera of 8 bits.
struct Scene {
  double noise_counts = 1.3;
  double period_px = 14.0;
  double light = 1.0;
  bool is_square = false;
  bool is_wall = false;  ///< before which nothing stands, with fringes along its columns
  unsigned seed = 1;

  [[nodiscard]] Image<std::uint8_t> frame(double shift_rad) const {
    std::mt19937 random(seed + static_cast<unsigned>(100.0 * shift_rad));
    std::normal_distribution<double> noise(0.0, noise_counts);
    Image<std::uint8_t> out(kWidth, kHeight, 0);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const double beside = std::hypot(x - 180.0, y - 140.0) / 130.0;
        const double round = beside < 1.0 ? light * (1.0 - 0.6 * beside * beside) : 0.0;
        const double albedo = is_wall ? 0.9 : round;
        const double turned = is_wall ? 0.0 : 0.004;
        double wave = std::cos(6.2832 * (x / period_px + turned * y) + shift_rad);
        if (is_square) wave = wave > 0.0 ? 1.0 : -1.0;
        const double counts = 6.0 + albedo * (110.0 + 95.0 * wave) + noise(random);
        out(x, y) = static_cast<std::uint8_t>(std::lround(std::clamp(counts, 0.0, 255.0)));
      }
    }
    return out;
  }
  /// Four frames, each changed by a function.
  template <typename Change>
  [[nodiscard]] std::vector<FrameStack> stacks(const Change& change) const {
    FrameStack out;
    for (const double shift_rad : {0.0, 1.57, 3.14, 4.71}) {
      out.pattern.shifts_rad.push_back(shift_rad);
      out.frames.emplace_back(change(frame(shift_rad)));
    }
    return {out};
  }
};

Image<std::uint8_t> as_taken(const Image<std::uint8_t>& image) {
  return image;
}

/// The image after libjpeg compressed it.
Image<std::uint8_t> compressed(const Image<std::uint8_t>& image, int quality) {
  const std::vector<std::uint8_t> bytes = testing::webcam_jpeg(
      image.width(), image.height(), quality, [&](int x, int y) { return image(x, y); });
  return decode_mjpeg(bytes, image.width(), image.height()).brightness;
}

template <typename Pixel>
Image<std::uint16_t> scaled(const Image<Pixel>& image, int factor) {
  Image<std::uint16_t> out(image.width(), image.height(), 0);
  for (std::size_t i = 0; i < out.pixels().size(); ++i)
    out.pixels()[i] = static_cast<std::uint16_t>(image.pixels()[i] * factor);
  return out;
}

/// The image with so many levels from 0 to 255.
Image<std::uint8_t> levelled(Image<std::uint8_t> image, int levels) {
  const double step = 255.0 / (levels - 1);
  for (std::uint8_t& counts : image.pixels())
    counts = static_cast<std::uint8_t>(std::lround(std::round(counts / step) * step));
  return image;
}

TEST(StorageLoss, FindsTheQualityOfACompression) {
  for (const int quality : {30, 50, 75, 85, 92}) {
    const StorageLoss loss = find_storage_loss(
        Scene{}.stacks([&](const auto& image) { return compressed(image, quality); }));
    EXPECT_NEAR(jpeg_quality_of_scale(loss.quality_scale), quality, 4.0) << quality;
    EXPECT_NEAR(std::log2(loss.variance_counts2 / jpeg_noise_counts2(quality)), 0.0, 0.7)
        << quality;
  }
}

TEST(StorageLoss, FindsItWhereverTheGridBegins) {
  const auto cropped = [](const auto& image) {
    const Image<std::uint8_t> whole = compressed(image, 75);
    Image<std::uint8_t> out(kWidth - 3, kHeight - 6, 0);
    for (int y = 0; y < out.height(); ++y)
      for (int x = 0; x < out.width(); ++x)
        out(x, y) = whole(x + 3, y + 6);
    return out;
  };
  const StorageLoss loss = find_storage_loss(Scene{}.stacks(cropped));
  EXPECT_NEAR(jpeg_quality_of_scale(loss.quality_scale), 75.0, 4.0);
}

TEST(StorageLoss, IsInTheCountsOfTheFile) {
  std::vector<FrameStack> stacks =
      Scene{}.stacks([](const auto& image) { return scaled(compressed(image, 50), 257); });
  stacks.front().white_level = 65535;
  const StorageLoss loss = find_storage_loss(stacks);
  EXPECT_EQ(loss.level_counts, 0.0);  // 8 bits are no loss
  EXPECT_NEAR(
      std::log2(loss.variance_counts2 / (257.0 * 257.0 * jpeg_noise_counts2(50))), 0.0, 0.7);
}

TEST(StorageLoss, FindsFewLevels) {
  for (const int levels : {12, 32, 64}) {
    const StorageLoss loss = find_storage_loss(
        Scene{}.stacks([&](const auto& image) { return levelled(image, levels); }));
    const double step = 255.0 / (levels - 1);
    EXPECT_EQ(loss.quality_scale, 0.0) << levels;
    EXPECT_NEAR(loss.level_counts / step, 1.0, 0.15) << levels;
    EXPECT_NEAR(loss.variance_counts2 / (step * step / 12.0), 1.0, 0.3) << levels;
  }
}

TEST(StorageLoss, IsNoneInFramesAsTheCameraTookThem) {
  for (const Scene& scene : {Scene{},
                             Scene{.noise_counts = 0.0},
                             Scene{.noise_counts = 0.4, .seed = 2},
                             Scene{.noise_counts = 5.0, .seed = 3},
                             Scene{.period_px = 8.0, .seed = 4},
                             Scene{.period_px = 16.0, .is_square = true, .seed = 5},
                             Scene{.period_px = 8.0, .is_square = true, .seed = 6},
                             Scene{.light = 0.05, .seed = 7}}) {
    const StorageLoss loss = find_storage_loss(scene.stacks(as_taken));
    EXPECT_EQ(loss.variance_counts2, 0.0) << "seed " << scene.seed;
    EXPECT_EQ(describe(loss), "") << "seed " << scene.seed;
    // 10 bits in the upper bits of 16.
    std::vector<FrameStack> deep =
        scene.stacks([](const auto& image) { return scaled(image, 4 * 64); });
    deep.front().white_level = 65535;
    EXPECT_EQ(find_storage_loss(deep).variance_counts2, 0.0) << "seed " << scene.seed;
  }
}

TEST(StorageLoss, IsNoneInRegularFringesOfAnyPeriod) {
  for (const double period_px : {6.0, 9.3, 12.0, 16.0, 17.0, 24.0, 33.0}) {
    for (const double noise_counts : {0.3, 1.0}) {
      const Scene scene{
          .noise_counts = noise_counts, .period_px = period_px, .is_wall = true, .seed = 8};
      EXPECT_EQ(find_storage_loss(scene.stacks(as_taken)).variance_counts2, 0.0)
          << period_px << ", noise " << noise_counts;
    }
  }
}

TEST(StorageLoss, IsNoneInImagesThatAreTooSmallOrDark) {
  FrameStack tiny;
  tiny.frames.assign(4, Frame(Image<std::uint8_t>(10, 10, 3)));
  EXPECT_EQ(find_storage_loss(std::vector{tiny}).variance_counts2, 0.0);
  FrameStack black;
  black.frames.assign(4, Frame(Image<std::uint8_t>(200, 200, 0)));
  EXPECT_EQ(find_storage_loss(std::vector{black}).variance_counts2, 0.0);
  EXPECT_EQ(find_storage_loss({}).variance_counts2, 0.0);
}

}  // namespace
}  // namespace frangia
