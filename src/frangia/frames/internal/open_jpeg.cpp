#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "frangia/frames/internal/exif_orientation.h"
#include "frangia/frames/internal/image_decoders.h"
#include "frangia/frames/internal/jpeg_codec.h"

namespace frangia {
namespace {

class JpegDecoder : public ImageDecoder {
 public:
  explicit JpegDecoder(std::shared_ptr<const ImageBytes> file) : file_(std::move(file)) {
    JpegCodec jpeg;
    open(jpeg);
    const jpeg_decompress_struct& codec = jpeg.codec;
    if (codec.num_components != 1 && codec.num_components != 3) {
      file_->fail(
          fmt::format("is a JPEG of {} channels; convert it to grey or to red, green and "
                      "blue",
                      codec.num_components));
    }
    info_ = {.codec = "jpeg",
             .width_px = static_cast<int>(codec.image_width),
             .height_px = static_cast<int>(codec.image_height),
             .channels = codec.num_components,
             .bits = 8};
    // A block of 64 samples takes at least one bit.
    constexpr double kMostPerByte = 64.0 * 8;
    file_->check_size(codec.image_width, codec.image_height, 1, 8 * info_.channels, kMostPerByte);
    info_.jpeg_quality = quality_of(jpeg);
    info_.orientation = orientation_of_jpeg(file_->bytes);
    if (!info_.jpeg_quality) file_->fail("is a JPEG without a quantization table; copy it again");
  }
  [[nodiscard]] const ImageInfo& info() const override { return info_; }
  [[nodiscard]] RasterImage read(std::size_t /*page*/) override {
    JpegCodec jpeg;
    open(jpeg);
    Image<std::uint8_t> image(info_.width_px * info_.channels, info_.height_px, Uninitialized{});
    const auto stride = static_cast<std::size_t>(image.width());
    if (!read_jpeg_rows(jpeg, image.pixels().data(), stride, info_.channels == 1)) {
      file_->fail(
          fmt::format("is truncated or damaged ({}); copy it again", jpeg.errors.message.data()));
    }
    return {std::move(image), info_.channels};
  }

 private:
  void open(JpegCodec& jpeg) const {
    const auto* const bytes = reinterpret_cast<const unsigned char*>(file_->bytes.data());
    if (!read_jpeg_header(jpeg, bytes, file_->bytes.size())) {
      file_->fail(fmt::format("is a JPEG that cannot be read ({})", jpeg.errors.message.data()));
    }
  }

  std::shared_ptr<const ImageBytes> file_;
  ImageInfo info_;
};

}  // namespace

std::unique_ptr<ImageDecoder> open_jpeg(std::shared_ptr<const ImageBytes> file) {
  if (!std::string_view(file->bytes.data(), file->bytes.size()).starts_with("\xff\xd8\xff"))
    return nullptr;
  return std::make_unique<JpegDecoder>(std::move(file));
}

}  // namespace frangia
