#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <spng.h>

#include "frangia/frames/internal/exif_orientation.h"
#include "frangia/frames/internal/image_decoders.h"

namespace frangia {
namespace {

struct FreePngContext {
  void operator()(spng_ctx* context) const { spng_ctx_free(context); }
};
using PngContext = std::unique_ptr<spng_ctx, FreePngContext>;

/// A libspng context that has read the header. A context decodes once.
PngContext open_png_context(const ImageBytes& file, spng_ihdr& header) {
  constexpr std::uint32_t kMaxSide = 65535;
  PngContext context(spng_ctx_new(0));
  spng_set_image_limits(context.get(), kMaxSide, kMaxSide);
  int error = spng_set_png_buffer(context.get(), file.bytes.data(), file.bytes.size());
  if (error == 0) error = spng_get_ihdr(context.get(), &header);
  if (error != 0) {
    file.fail(fmt::format("is a damaged PNG image ({}); copy it again", spng_strerror(error)));
  }
  return context;
}

class PngDecoder : public ImageDecoder {
 public:
  explicit PngDecoder(std::shared_ptr<const ImageBytes> file) : file_(std::move(file)) {
    spng_ihdr header{};
    static_cast<void>(open_png_context(*file_, header));
    const bool grey = header.color_type == SPNG_COLOR_TYPE_GRAYSCALE ||
                      header.color_type == SPNG_COLOR_TYPE_GRAYSCALE_ALPHA;
    const bool alpha = header.color_type == SPNG_COLOR_TYPE_GRAYSCALE_ALPHA ||
                       header.color_type == SPNG_COLOR_TYPE_TRUECOLOR_ALPHA;
    const bool wide = header.bit_depth == 16;
    stored_ = alpha ? 4 : grey ? 1 : 3;
    if (alpha) {
      format_ = wide ? SPNG_FMT_RGBA16 : SPNG_FMT_RGBA8;
    } else if (wide) {
      format_ = SPNG_FMT_PNG;
    } else {
      format_ = grey ? SPNG_FMT_G8 : SPNG_FMT_RGB8;
    }
    info_ = {.codec = "png",
             .width_px = static_cast<int>(header.width),
             .height_px = static_cast<int>(header.height),
             .channels = grey ? 1 : 3,
             .bits = wide ? 16 : 8};
    info_.orientation = orientation_of_png(file_->bytes);
    constexpr double kMostPerByte = 1032.0 * 8;  // deflate (zlib), and eight pixels of a bit each
    file_->check_size(header.width, header.height, stored_, info_.bits, kMostPerByte);
  }
  [[nodiscard]] const ImageInfo& info() const override { return info_; }
  [[nodiscard]] RasterImage read(std::size_t /*page*/) override {
    if (info_.bits == 16) return {decode<std::uint16_t>(), info_.channels};
    return {decode<std::uint8_t>(), info_.channels};
  }

 private:
  template <typename T>
  [[nodiscard]] Image<T> decode() const {
    spng_ihdr header{};
    const PngContext context = open_png_context(*file_, header);
    Image<T> image(info_.width_px * stored_, info_.height_px, Uninitialized{});
    std::size_t size = 0;
    int error = spng_decoded_image_size(context.get(), format_, &size);
    if (error == 0 && size != image.pixels().size_bytes()) error = SPNG_EINTERNAL;
    if (error == 0)
      error = spng_decode_image(context.get(), image.pixels().data(), size, format_, 0);
    if (error != 0) {
      file_->fail(fmt::format("is truncated or damaged ({}); copy it again", spng_strerror(error)));
    }
    return without_alpha(std::move(image), stored_, info_.channels);
  }

  std::shared_ptr<const ImageBytes> file_;
  ImageInfo info_;
  int stored_ = 1;
  int format_ = SPNG_FMT_G8;
};

}  // namespace

std::unique_ptr<ImageDecoder> open_png(std::shared_ptr<const ImageBytes> file) {
  constexpr std::string_view kMagic = "\x89PNG\r\n\x1a\n";
  if (!std::string_view(file->bytes.data(), file->bytes.size()).starts_with(kMagic)) return nullptr;
  return std::make_unique<PngDecoder>(std::move(file));
}

}  // namespace frangia
