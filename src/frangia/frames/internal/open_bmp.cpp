#include <algorithm>
#include <cstring>
#include <limits>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "frangia/frames/internal/image_decoders.h"

// stb_image, for BMP alone.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_BMP
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#define STBI_MAX_DIMENSIONS 65535
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace frangia {
namespace {

class BmpDecoder : public ImageDecoder {
 public:
  explicit BmpDecoder(std::shared_ptr<const ImageBytes> file) : file_(std::move(file)) {
    if (file_->bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
      file_->fail("is a BMP of more than 2 GB; split it");
    int width_px = 0;
    int height_px = 0;
    int stored = 0;
    if (stbi_info_from_memory(data(), size(), &width_px, &height_px, &stored) == 0) {
      file_->fail(fmt::format("is a BMP that cannot be read ({}); write it without compression",
                              stbi_failure_reason()));
    }
    info_ = {.codec = "bmp", .width_px = width_px, .height_px = height_px, .channels = 3};
    // A bit per pixel at least, which becomes three samples.
    constexpr double kMostPerByte = 8.0 * 3;
    file_->check_size(static_cast<std::uint64_t>(std::max(width_px, 0)),
                      static_cast<std::uint64_t>(std::max(height_px, 0)),
                      3,
                      info_.bits,
                      kMostPerByte);
    check_length();
  }
  [[nodiscard]] const ImageInfo& info() const override { return info_; }
  [[nodiscard]] RasterImage read(std::size_t /*page*/) override {
    int width_px = 0;
    int height_px = 0;
    int stored = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(data(), size(), &width_px, &height_px, &stored, 3), stbi_image_free);
    if (!pixels || width_px != info_.width_px || height_px != info_.height_px) {
      file_->fail(
          fmt::format("is truncated or damaged ({}); copy it again", stbi_failure_reason()));
    }
    Image<std::uint8_t> image(width_px * 3, height_px, Uninitialized{});
    std::memcpy(image.pixels().data(), pixels.get(), image.pixels().size_bytes());
    return {std::move(image), 3};
  }

 private:
  /// Refuses a truncated file, whose missing pixels stb_image would set to 0.
  void check_length() const {
    constexpr std::size_t kInfoHeader = 30;  // up to the bits of a pixel
    if (file_->bytes.size() < kInfoHeader) file_->fail("is a truncated BMP; copy it again");
    const bool old = field(14, 4) == 12;  // OS/2 header
    const std::uint64_t bits = old ? field(24, 2) : field(28, 2);
    const std::uint64_t row = (static_cast<std::uint64_t>(info_.width_px) * bits + 31) / 32 * 4;
    const std::uint64_t needed = field(10, 4) + row * static_cast<std::uint64_t>(info_.height_px);
    if (needed > file_->bytes.size()) {
      file_->fail(fmt::format(
          "is truncated: it has {} of {} bytes; copy it again", file_->bytes.size(), needed));
    }
  }
  /// A little-endian number of the header.
  [[nodiscard]] std::uint64_t field(std::size_t at, std::size_t length) const {
    std::uint64_t value = 0;
    for (std::size_t i = length; i-- > 0;)
      value = value << 8U | static_cast<unsigned char>(file_->bytes[at + i]);
    return value;
  }
  [[nodiscard]] const stbi_uc* data() const {
    return reinterpret_cast<const stbi_uc*>(file_->bytes.data());
  }
  [[nodiscard]] int size() const { return static_cast<int>(file_->bytes.size()); }

  std::shared_ptr<const ImageBytes> file_;
  ImageInfo info_;
};

}  // namespace

std::unique_ptr<ImageDecoder> open_bmp(std::shared_ptr<const ImageBytes> file) {
  if (!std::string_view(file->bytes.data(), file->bytes.size()).starts_with("BM")) return nullptr;
  return std::make_unique<BmpDecoder>(std::move(file));
}

}  // namespace frangia
