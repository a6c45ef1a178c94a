#include "frangia/frames/png.h"

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <spng.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"
#include "frangia/core/read_file.h"
#include "frangia/frames/encode_picture.h"
#include "frangia/frames/internal/exif_orientation.h"
#include "frangia/frames/internal/image_decoders.h"

namespace frangia {
namespace {

/// Protects against headers that request absurd amounts of memory; px.
constexpr std::uint32_t kMaxSide = 65535;

/// Protects against sparse files. A camera of 250 megapixels and 16 bits gives 500 MB.
constexpr std::size_t kMaxBytes = std::size_t{1} << 30U;

struct FreeContext {
  void operator()(spng_ctx* context) const { spng_ctx_free(context); }
};
using Context = std::unique_ptr<spng_ctx, FreeContext>;

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what) {
  throw Error(ErrorKind::Input, fmt::format("{}: {}", path.string(), what));
}

/// Reads and checks the header of a PNG, whose first bytes are `bytes`.
spng_ihdr read_header(spng_ctx* context,
                      const std::vector<char>& bytes,
                      const std::filesystem::path& path) {
  spng_set_image_limits(context, kMaxSide, kMaxSide);
  if (spng_set_png_buffer(context, bytes.data(), bytes.size()) != 0) {
    fail(path, "cannot be decoded; copy or capture the frame again");
  }
  spng_ihdr header{};
  if (const int error = spng_get_ihdr(context, &header); error != 0) {
    fail(path, fmt::format("is not a PNG image ({}); frames are grey PNGs", spng_strerror(error)));
  }
  if (header.color_type != SPNG_COLOR_TYPE_GRAYSCALE) {
    fail(path, "is a colour PNG; frames are grey: convert it from the camera's raw data");
  }
  return header;
}

/// Refuses a size that the file cannot hold or that no camera has, before memory is allocated.
void require_plausible_size(const spng_ihdr& header,
                            std::size_t file_bytes,
                            const std::filesystem::path& path) {
  constexpr std::uint64_t kMaxPixels = 250'000'000;
  constexpr std::uint64_t kMaxRatio = 1032;  // of deflate; zlib, "Maximum Compression Factor"
  const std::uint64_t pixels = std::uint64_t{header.width} * header.height;
  if (pixels > kMaxPixels) {
    fail(path,
         fmt::format("has {} x {} pixels, more than the {} million of the largest frame",
                     header.width,
                     header.height,
                     kMaxPixels / 1'000'000));
  }
  if (pixels * header.bit_depth / 8 > kMaxRatio * file_bytes) {
    fail(path,
         fmt::format("is truncated or damaged: its {} bytes cannot hold {} x {} pixels; copy or "
                     "capture it again",
                     file_bytes,
                     header.width,
                     header.height));
  }
}

template <typename T>
Image<T> decode(spng_ctx* context,
                const spng_ihdr& header,
                int format,
                const std::filesystem::path& path) {
  std::size_t size = 0;
  if (spng_decoded_image_size(context, format, &size) != 0) fail(path, "has a broken header");
  Image<T> image(static_cast<int>(header.width), static_cast<int>(header.height), Uninitialized{});
  if (size != image.pixels().size_bytes()) fail(path, "has a broken header");
  const int error = spng_decode_image(context, image.pixels().data(), size, format, 0);
  if (error != 0) {
    fail(path,
         fmt::format("is truncated or damaged ({}); copy or capture it again",
                     spng_strerror(error)));
  }
  return image;
}

std::vector<char> encode(const spng_ihdr& header, const void* pixels, std::size_t size) {
  const Context context(spng_ctx_new(SPNG_CTX_ENCODER));
  spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1);
  // Compression level 2 takes a third of the default's time and gives files a tenth larger; a scan
  // has hundreds of frames.
  spng_set_option(context.get(), SPNG_IMG_COMPRESSION_LEVEL, 2);
  spng_ihdr copy = header;
  spng_set_ihdr(context.get(), &copy);
  int error = spng_encode_image(context.get(), pixels, size, SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE);
  std::size_t length = 0;
  void* encoded = error == 0 ? spng_get_png_buffer(context.get(), &length, &error) : nullptr;
  // The caller of libspng frees the buffer.
  const std::unique_ptr<void, void (*)(void*)> owner(encoded, std::free);  // NOLINT
  if (encoded == nullptr) {
    throw Error(ErrorKind::File,
                fmt::format("an image cannot be encoded as PNG: {}", spng_strerror(error)));
  }
  const auto* bytes = static_cast<const char*>(encoded);
  return {bytes, bytes + length};
}

void write_atomically(const std::filesystem::path& path, const std::vector<char>& bytes) {
  write_text_file(path, {bytes.data(), bytes.size()});
}

template <typename T>
spng_ihdr header_of(const Image<T>& image, int bit_depth, int color_type) {
  return {.width = static_cast<std::uint32_t>(image.width()),
          .height = static_cast<std::uint32_t>(image.height()),
          .bit_depth = static_cast<std::uint8_t>(bit_depth),
          .color_type = static_cast<std::uint8_t>(color_type),
          .compression_method = 0,
          .filter_method = 0,
          .interlace_method = 0};
}

}  // namespace

Frame read_png(const std::filesystem::path& path, const PngSizeCheck& check_size) {
  const std::vector<char> bytes = read_regular_file(path, kMaxBytes);
  if (bytes.empty()) fail(path, "is an empty file of 0 bytes; copy or capture the frame again");
  const Context context(spng_ctx_new(0));
  const spng_ihdr header = read_header(context.get(), bytes, path);
  if (check_size) check_size(static_cast<int>(header.width), static_cast<int>(header.height));
  require_plausible_size(header, bytes.size(), path);
  if (header.bit_depth == 16) {
    return decode<std::uint16_t>(context.get(), header, SPNG_FMT_PNG, path);
  }
  return decode<std::uint8_t>(context.get(), header, SPNG_FMT_G8, path);
}

std::vector<char> encode_png(const Frame& frame) {
  return std::visit(
      [&](const auto& image) {
        const int depth = 8 * static_cast<int>(sizeof(image.pixels()[0]));
        return encode(header_of(image, depth, SPNG_COLOR_TYPE_GRAYSCALE),
                      image.pixels().data(),
                      image.pixels().size_bytes());
      },
      frame);
}

void write_png(const std::filesystem::path& path, const Frame& frame) {
  write_atomically(path, encode_png(frame));
}

std::vector<char> encode_picture(const Image<Rgb>& picture) {
  return encode(header_of(picture, 8, SPNG_COLOR_TYPE_TRUECOLOR),
                picture.pixels().data(),
                picture.pixels().size_bytes());
}

void write_png(const std::filesystem::path& path, const Image<Rgb>& picture) {
  write_atomically(path, encode_picture(picture));
}

void write_png(const std::filesystem::path& path, const RasterImage& image) {
  const auto bytes = std::visit(
      [&](const auto& samples) -> std::vector<char> {
        using Sample = std::remove_cvref_t<decltype(samples.pixels()[0])>;
        if constexpr (std::is_floating_point_v<Sample>) {
          fail(path, "floating-point samples do not fit into a PNG");
        } else {
          spng_ihdr header = header_of(
              samples,
              8 * static_cast<int>(sizeof(Sample)),
              image.channels == 3 ? SPNG_COLOR_TYPE_TRUECOLOR : SPNG_COLOR_TYPE_GRAYSCALE);
          header.width = static_cast<std::uint32_t>(image.width_px());
          return encode(header, samples.pixels().data(), samples.pixels().size_bytes());
        }
      },
      image.samples);
  write_atomically(path, bytes);
}

namespace {

struct FreePngContext {
  void operator()(spng_ctx* context) const { spng_ctx_free(context); }
};
using PngContext = std::unique_ptr<spng_ctx, FreePngContext>;

/// A libspng context that has read the header. A context decodes once.
PngContext open_png_context(const ImageBytes& file, spng_ihdr& header) {
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
