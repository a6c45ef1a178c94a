// The files are made by OpenCV and NumPy: tests/data/make_images.py.
#include "frangia/frames/image_file.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/error_of.h"
#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::error_of;
using testing::TemporaryFolder;

std::filesystem::path image_path(const std::string& name) {
  return std::filesystem::path(FRANGIA_SOURCE_DIR) / "tests/data/images" / name;
}

/// The grey value of the test images, of 8 bits.
int grey_at(int x, int y) {
  return 20 * x + 7 * y + 3;
}

double sample_at(const RasterImage& image, int x, int y, int channel = 0) {
  return std::visit(
      [&](const auto& samples) {
        return static_cast<double>(samples(x * image.channels + channel, y));
      },
      image.samples);
}

void expect_grey(const RasterImage& image, double scale, const std::string& name) {
  ASSERT_EQ(image.channels, 1) << name;
  ASSERT_EQ(image.width_px(), 11) << name;
  ASSERT_EQ(image.height_px(), 6) << name;
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 11; ++x)
      EXPECT_NEAR(sample_at(image, x, y), scale * grey_at(x, y), 1e-6) << name << x << ' ' << y;
  }
}

TEST(ImageFile, ReadsGreyImagesOfOtherPrograms) {
  for (const char* name :
       {"grey8.png", "grey8.tiff", "raw.tiff", "grey8.pgm", "text.pgm", "grey8.npy"})
    expect_grey(ImageFile(image_path(name)).read(), 1.0, name);
  for (const char* name : {"grey16.png", "grey16.tiff", "deflate.tiff", "grey16.pgm"})
    expect_grey(ImageFile(image_path(name)).read(), 257.0, name);
  expect_grey(ImageFile(image_path("float.tiff")).read(), 1.0 / 255.0, "float.tiff");
  expect_grey(ImageFile(image_path("float64.npy")).read(), 1.0 / 255.0, "float64.npy");
  expect_grey(ImageFile(image_path("int64.npy")).read(), 1.0, "int64.npy");
}

TEST(ImageFile, ReadsColorsInTheOrderRedGreenBlue) {
  for (const char* name :
       {"color8.png", "alpha8.png", "color8.tiff", "color8.bmp", "color8.ppm", "color.npy"}) {
    const RasterImage image = ImageFile(image_path(name)).read();
    ASSERT_EQ(image.channels, 3) << name;
    for (int y = 0; y < 6; ++y) {
      for (int x = 0; x < 11; ++x) {
        EXPECT_EQ(sample_at(image, x, y, 0), grey_at(x, y)) << name;
        EXPECT_EQ(sample_at(image, x, y, 1), 255 - grey_at(x, y)) << name;
        EXPECT_EQ(sample_at(image, x, y, 2), 5 * y) << name;
      }
    }
  }
  EXPECT_EQ(sample_at(ImageFile(image_path("color16.png")).read(), 3, 2, 0), 257 * grey_at(3, 2));
}

TEST(ImageFile, ReadsAGreyBmpAsThreeEqualChannels) {
  const RasterImage image = ImageFile(image_path("grey8.bmp")).read();
  for (int channel = 0; channel < 3; ++channel)
    EXPECT_EQ(sample_at(image, 4, 5, channel), grey_at(4, 5));
}

TEST(ImageFile, ReadsJpegsAndTheirQuality) {
  const std::vector<std::pair<std::string, int>> files = {{"grey.jpg", 85},
                                                          {"progressive.jpg", 95}};
  for (const auto& [name, quality] : files) {
    const ImageFile file(image_path(name));
    EXPECT_EQ(file.info().jpeg_quality, quality) << name;
    const RasterImage image = file.read();
    ASSERT_EQ(image.width_px(), 33) << name;
    // The image is enlarged three times, so that every third pixel is that of the small one.
    for (int y = 1; y < 6; ++y)
      for (int x = 1; x < 10; ++x)
        EXPECT_NEAR(sample_at(image, 3 * x + 1, 3 * y + 1), grey_at(x, y), 8) << name;
  }
  const ImageFile color(image_path("color.jpg"));
  EXPECT_EQ(color.info().jpeg_quality, 60);
  EXPECT_EQ(color.info().channels, 3);
}

TEST(ImageFile, ReadsThePagesOfAStack) {
  const ImageFile tiff(image_path("pages.tiff"));
  ASSERT_EQ(tiff.info().pages, 3U);
  EXPECT_EQ(sample_at(tiff.read(1), 3, 2), 255 - grey_at(3, 2));
  EXPECT_EQ(sample_at(tiff.read(2), 3, 2), grey_at(3, 2) / 2);
  EXPECT_EQ(sample_at(tiff.read(0), 3, 2), grey_at(3, 2));
  const ImageFile npy(image_path("stack16.npy"));
  ASSERT_EQ(npy.info().pages, 2U);
  EXPECT_EQ(sample_at(npy.read(1), 3, 2), 65535 - 257 * grey_at(3, 2));
}

TEST(ImageFile, KeepsTheStatedFullScaleOfTwelveBits) {
  const ImageFile pgm(image_path("grey12.pgm"));
  EXPECT_EQ(pgm.info().white_level, 4095);
  EXPECT_EQ(sample_at(pgm.read(), 3, 2), 257 * grey_at(3, 2) / 16);
  ImageFileOptions options;
  options.raw = parse_raw_format("11x6x12be");
  const ImageFile raw(image_path("grey12be.raw"), options);
  EXPECT_EQ(raw.info().white_level, 4095);
  EXPECT_EQ(sample_at(raw.read(), 3, 2), 257 * grey_at(3, 2) / 16);
  options.raw = parse_raw_format("11x6x12le");
  const std::string swapped =
      error_of([&] { static_cast<void>(ImageFile(image_path("grey12be.raw"), options).read()); });
  EXPECT_NE(swapped.find("order of the bytes in `raw`"), std::string::npos) << swapped;
}

TEST(ImageFile, RefusesRawSamplesOfAnotherSize) {
  ImageFileOptions options;
  options.raw = parse_raw_format("12x6x16");
  const std::string error = error_of([&] { ImageFile(image_path("grey12be.raw"), options); });
  EXPECT_NE(error.find("grey12be.raw: has 132 bytes, not a multiple of the 144 bytes"),
            std::string::npos)
      << error;
  for (const char* text : {"", "12", "12x", "12x6", "12x6x7", "12x6x17", "0x6x8", "12x6x8ee"})
    EXPECT_NE(error_of([&] { static_cast<void>(parse_raw_format(text)); }).find("`raw` is"),
              std::string::npos)
        << text;
}

TEST(ImageFile, RefusesATruncatedFileOfEveryFormat) {
  const TemporaryFolder folder;
  for (const char* name : {"grey8.png",
                           "grey16.tiff",
                           "grey8.bmp",
                           "grey.jpg",
                           "grey8.pgm",
                           "text.pgm",
                           "stack16.npy",
                           "progressive.jpg"}) {
    std::ifstream in(image_path(name), std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(in), {}};
    const auto path = folder.path() / name;
    for (const double share : {0.1, 0.5, 0.8}) {
      std::ofstream(path, std::ios::binary)
          << bytes.substr(0, static_cast<std::size_t>(share * static_cast<double>(bytes.size())));
      const std::string error = error_of([&] { static_cast<void>(ImageFile(path).read()); });
      EXPECT_NE(error.find(path.string()), std::string::npos) << name << ' ' << share;
    }
  }
}

TEST(ImageFile, RefusesSizesThatTheFileCannotHold) {
  const TemporaryFolder folder;
  const auto complaint = [&](const std::string& bytes) {
    const auto path = folder.path() / "image";
    std::ofstream(path, std::ios::binary) << bytes;
    return error_of([&] { static_cast<void>(ImageFile(path).read()); });
  };
  const std::string large = complaint("P5 60000 60000 255\nabc");
  EXPECT_NE(large.find("has 60000 x 60000 pixels, more than"), std::string::npos) << large;
  const std::string short_of = complaint("P5 6000 6000 255\nabc");
  EXPECT_NE(short_of.find("cannot hold 6000 x 6000 pixels"), std::string::npos) << short_of;
  std::string header = "{'descr': '<u2', 'fortran_order': False, 'shape': (900, 4000, 4000), }\n";
  header = std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(header.size()) + '\0' + header;
  EXPECT_NE(complaint(header).find("cannot hold 4000 x 4000 pixels"), std::string::npos);
  EXPECT_NE(complaint("hello").find("is not an image that can be imported"), std::string::npos);
  EXPECT_NE(complaint("").find("empty file"), std::string::npos);
}

}  // namespace
}  // namespace frangia
