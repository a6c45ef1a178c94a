#include "frangia/frames/png.h"

#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "frangia/core/checksums.h"
#include "frangia/core/error.h"

#include "support/temporary_folder.h"

namespace frangia {
namespace {

using testing::TemporaryFolder;

template <typename T>
Image<T> ramp(int width, int height, int step) {
  Image<T> image(width, height);
  for (std::size_t i = 0; i < image.pixels().size(); ++i)
    image.pixels()[i] = static_cast<T>(i * static_cast<std::size_t>(step));
  return image;
}

std::string error_message(const std::filesystem::path& path) {
  try {
    static_cast<void>(read_png(path));
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Input);
    EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos);
    return error.what();
  }
  return "accepted";
}

TEST(Png, ReadsBackEightAndSixteenBitFrames) {
  const TemporaryFolder folder;
  const auto eight = ramp<std::uint8_t>(37, 21, 1);
  const auto sixteen = ramp<std::uint16_t>(37, 21, 83);
  write_png(folder.path() / "8.png", Frame(eight));
  write_png(folder.path() / "16.png", Frame(sixteen));
  const Frame back8 = read_png(folder.path() / "8.png");
  const Frame back16 = read_png(folder.path() / "16.png");
  for (int y = 0; y < 21; ++y) {
    for (int x = 0; x < 37; ++x) {
      EXPECT_EQ(std::get<0>(back8)(x, y), eight(x, y));
      EXPECT_EQ(std::get<1>(back16)(x, y), sixteen(x, y));
    }
  }
}

TEST(Png, RefusesColour) {
  const TemporaryFolder folder;
  write_png(folder.path() / "rgb.png", Image<Rgb>(5, 5));
  EXPECT_NE(error_message(folder.path() / "rgb.png").find("colour"), std::string::npos);
}

TEST(Png, RefusesAFileTruncatedAtAnyLength) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "cut.png";
  write_png(path, Frame(ramp<std::uint8_t>(64, 64, 7)));
  for (auto size = std::filesystem::file_size(path) - 20; size > 0; size = size * 2 / 3) {
    std::filesystem::resize_file(path, size);
    EXPECT_NE(error_message(path), "accepted") << size;
  }
}

TEST(Png, RefusesASizeThatTheFileCannotHoldBeforeItAllocatesMemory) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "frame.png";
  // Signature and header: the size is at byte 16, the CRC-32 of the header follows its 17 bytes.
  const auto refusal_of = [&](std::uint32_t width, std::uint32_t height) {
    std::vector<char> bytes = encode_png(Frame(Image<std::uint16_t>(8, 8, 7)));
    for (std::size_t i = 0; i < 4; ++i) {
      bytes[16 + i] = static_cast<char>(width >> (24 - 8 * i) & 0xFFU);
      bytes[20 + i] = static_cast<char>(height >> (24 - 8 * i) & 0xFFU);
    }
    const std::uint32_t sum = crc32(std::span<const char>(bytes).subspan(12, 17));
    for (std::size_t i = 0; i < 4; ++i)
      bytes[29 + i] = static_cast<char>(sum >> (24 - 8 * i) & 0xFFU);
    std::ofstream(path, std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return error_message(path);
  };
  EXPECT_NE(refusal_of(65'535, 65'535).find("65535 x 65535 pixels, more than"), std::string::npos);
  EXPECT_NE(refusal_of(9'000, 9'000).find("cannot hold 9000 x 9000 pixels"), std::string::npos);
}

TEST(Png, RefusesMissingEmptyAndForeignFiles) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "text.png") << "not a picture";
  std::ofstream(folder.path() / "empty.png") << "";
  EXPECT_NE(error_message(folder.path() / "text.png"), "accepted");
  EXPECT_NE(error_message(folder.path() / "empty.png").find("is an empty file"), std::string::npos);
  EXPECT_NE(error_message(folder.path() / "none.png").find("does not exist"), std::string::npos);
}

TEST(Png, ChecksTheSizeInTheHeaderBeforeDecodingAnyPixel) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "cut.png";
  write_png(path, Frame(ramp<std::uint8_t>(64, 64, 7)));
  std::filesystem::resize_file(path, 60);  // signature, header and the beginning of the pixels
  try {
    static_cast<void>(read_png(path, [](int width_px, int height_px) {
      throw Error(ErrorKind::Input, std::to_string(width_px) + " x " + std::to_string(height_px));
    }));
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "64 x 64");
  }
}

TEST(Png, RefusesANamedPipeAndAFolderAtOnce) {
  const TemporaryFolder folder;
  const auto pipe = folder.path() / "pipe.png";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_NE(error_message(pipe).find("is a named pipe"), std::string::npos);
  EXPECT_NE(error_message(folder.path()).find("is a folder"), std::string::npos);
}

}  // namespace
}  // namespace frangia
