#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "frangia/frames/internal/image_decoders.h"

namespace frangia {
namespace {

/// Samples of 8 to 16 bits, of which more than 8 take two bytes.
class RawDecoder : public ImageDecoder {
 public:
  RawDecoder(std::shared_ptr<const ImageBytes> file, const RawFormat& format)
      : file_(std::move(file)),
        info_{.codec = "raw",
              .width_px = format.width_px,
              .height_px = format.height_px,
              .bits = format.bits > 8 ? 16 : 8,
              .white_level = (1 << format.bits) - 1},
        is_big_endian_(format.is_big_endian) {
    page_bytes_ = static_cast<std::size_t>(format.width_px) *
                  static_cast<std::size_t>(format.height_px) *
                  static_cast<std::size_t>(info_.bits / 8);
    if (file_->bytes.size() % page_bytes_ != 0) {
      file_->fail(
          fmt::format("has {} bytes, not a multiple of the {} bytes of a frame of {} x {} "
                      "pixels; correct `raw`",
                      file_->bytes.size(),
                      page_bytes_,
                      format.width_px,
                      format.height_px));
    }
    info_.pages = file_->bytes.size() / page_bytes_;
  }
  [[nodiscard]] const ImageInfo& info() const override { return info_; }
  [[nodiscard]] RasterImage read(std::size_t page) override {
    const char* at = file_->bytes.data() + page * page_bytes_;
    if (info_.bits == 8) {
      Image<std::uint8_t> image(info_.width_px, info_.height_px, Uninitialized{});
      std::memcpy(image.pixels().data(), at, page_bytes_);
      return {std::move(image), 1};
    }
    Image<std::uint16_t> image(info_.width_px, info_.height_px, Uninitialized{});
    for (std::uint16_t& sample : image.pixels()) {
      const auto first = static_cast<unsigned char>(*at++);
      const auto second = static_cast<unsigned char>(*at++);
      sample =
          static_cast<std::uint16_t>(is_big_endian_ ? 256 * first + second : 256 * second + first);
      if (sample > info_.white_level) {
        file_->fail(
            fmt::format("holds the value {}, above the {} of its bits; correct the bits or the "
                        "order of the bytes in `raw`",
                        sample,
                        info_.white_level));
      }
    }
    return {std::move(image), 1};
  }

 private:
  std::shared_ptr<const ImageBytes> file_;
  ImageInfo info_;
  std::size_t page_bytes_ = 0;
  bool is_big_endian_ = false;
};

}  // namespace

std::unique_ptr<ImageDecoder> open_raw(std::shared_ptr<const ImageBytes> file,
                                       const RawFormat& format) {
  return std::make_unique<RawDecoder>(std::move(file), format);
}

}  // namespace frangia
