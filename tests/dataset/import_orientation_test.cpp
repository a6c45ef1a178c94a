// Frames whose EXIF orientation states that they are shown turned.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <variant>

#include <gtest/gtest.h>

#include "frangia/core/checksums.h"
#include "frangia/dataset/import_frames.h"
#include "frangia/dataset/read_frames.h"
#include "frangia/frames/png.h"
#include "frangia/rig/write_rig.h"

#include "dataset/import_fixture.h"

namespace frangia {
namespace {

class ImportOrientation : public testing::ImportFixture {
 protected:
  /// A rig with a digital projector and a camera of this size.
  void use_rig(int width_px, int height_px) {
    options_.rig = images().parent_path() / "rig.toml";
    write_rig(options_.rig, rig_of_images(width_px, height_px));
  }
  /// States an EXIF orientation in a PNG.
  void orient(const std::string& name, char orientation) const {
    std::string bytes = testing::bytes_of(images() / name);
    const std::string exif = std::string("eXIfII*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0", 22) +
                             orientation + std::string(7, '\0');
    const auto number = [](std::uint32_t value) {
      std::string text;
      for (const unsigned shift : {24U, 16U, 8U, 0U})
        text += static_cast<char>(value >> shift & 0xFFU);
      return text;
    };
    constexpr std::size_t kAfterHeader = 33;
    const std::uint32_t check = crc32(exif);
    bytes.insert(kAfterHeader,
                 number(static_cast<std::uint32_t>(exif.size() - 4)) + exif + number(check));
    std::ofstream(images() / name, std::ios::binary) << bytes;
  }
};

TEST_F(ImportOrientation, AsksWhichPixelsAreTheCamerasWhereTheRigFitsBoth) {
  options_.names = "{frame}.png";
  for (int k = 0; k < 4; ++k) {
    Image<std::uint8_t> image(8, 6, 10);
    image(1, 2) = static_cast<std::uint8_t>(100 + k);
    const std::string name = std::to_string(k) + ".png";
    write_png(images() / name, Frame(image));
    orient(name, 3);  // by 180 degrees
  }
  use_rig(8, 6);
  const std::string asks = complaint();
  EXPECT_NE(asks.find("EXIF orientation 3"), std::string::npos) << asks;
  EXPECT_NE(asks.find("set `orientation` to stored"), std::string::npos) << asks;

  const auto frame = [&] {
    const Scan scan = import();
    auto stacks = read_frames(scan, 0);
    std::filesystem::remove_all(target());
    return std::get<Image<std::uint8_t>>(stacks.front().frames.front());
  };
  options_.orientation = FrameOrientation::Stored;
  EXPECT_EQ(frame()(1, 2), 100);
  options_.orientation = FrameOrientation::Shown;
  EXPECT_EQ(frame()(6, 3), 100);
}

TEST_F(ImportOrientation, TurnsFramesOfWhichOnlyTheShownPixelsFitTheRig) {
  options_.names = "{frame}.png";
  for (int k = 0; k < 4; ++k) {
    Image<std::uint8_t> image(8, 6, 10);
    image(1, 2) = 100;
    const std::string name = std::to_string(k) + ".png";
    write_png(images() / name, Frame(image));
    orient(name, 6);  // by 90 degrees clockwise
  }
  use_rig(6, 8);
  const auto stacks = read_frames(import(), 0);
  const auto& image = std::get<Image<std::uint8_t>>(stacks.front().frames.front());
  ASSERT_EQ(image.width(), 6);
  EXPECT_EQ(image(3, 1), 100);  // row 2 from the top is column 2 from the right
}

}  // namespace
}  // namespace frangia
