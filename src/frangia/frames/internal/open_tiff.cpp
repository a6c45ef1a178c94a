#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <tiffio.h>

#include "frangia/frames/internal/image_decoders.h"

namespace frangia {
namespace {

/// A position in a file in memory, for the callbacks of libtiff.
struct TiffStream {
  const ImageBytes* file;
  std::uint64_t at = 0;
};

tmsize_t read_tiff_bytes(thandle_t handle, void* target, tmsize_t count) {
  auto* const stream = static_cast<TiffStream*>(handle);
  const std::uint64_t size = stream->file->bytes.size();
  if (stream->at >= size || count <= 0) return 0;
  const auto got = std::min(static_cast<std::uint64_t>(count), size - stream->at);
  std::memcpy(target, stream->file->bytes.data() + stream->at, got);
  stream->at += got;
  return static_cast<tmsize_t>(got);
}

tmsize_t refuse_to_write(thandle_t /*handle*/, void* /*source*/, tmsize_t /*count*/) {
  return -1;
}

toff_t seek_tiff(thandle_t handle, toff_t offset, int whence) {
  auto* const stream = static_cast<TiffStream*>(handle);
  const std::uint64_t base = whence == SEEK_SET   ? 0
                             : whence == SEEK_CUR ? stream->at
                                                  : stream->file->bytes.size();
  stream->at = base + offset;
  return stream->at;
}

int close_tiff(thandle_t /*handle*/) {
  return 0;
}

toff_t size_of_tiff(thandle_t handle) {
  return static_cast<TiffStream*>(handle)->file->bytes.size();
}

int map_no_file(thandle_t /*handle*/, void** /*base*/, toff_t* /*size*/) {
  return 0;
}

void unmap_no_file(thandle_t /*handle*/, void* /*base*/, toff_t /*size*/) {}

/// How the samples of a page are stored.
struct TiffPage {
  std::uint32_t width_px = 0;
  std::uint32_t height_px = 0;
  std::uint16_t bits = 1;
  std::uint16_t stored = 1;  ///< samples per pixel, with alpha
  std::uint16_t format = SAMPLEFORMAT_UINT;
  std::uint16_t photometric = PHOTOMETRIC_MINISBLACK;

  friend bool operator==(const TiffPage&, const TiffPage&) = default;
};

class TiffDecoder : public ImageDecoder {
 public:
  explicit TiffDecoder(std::shared_ptr<const ImageBytes> file)
      : file_(std::move(file)), stream_{file_.get()} {
    // libtiff prints to standard error otherwise; the errors thrown here name the file.
    [[maybe_unused]] static const bool quiet = [] {
      TIFFSetErrorHandler(nullptr);
      TIFFSetWarningHandler(nullptr);
      return true;
    }();
    tiff_.reset(TIFFClientOpen("",
                               "rm",
                               &stream_,
                               read_tiff_bytes,
                               refuse_to_write,
                               seek_tiff,
                               close_tiff,
                               size_of_tiff,
                               map_no_file,
                               unmap_no_file));
    if (!tiff_) file_->fail("is a damaged TIFF; copy it again");
    page_ = described_page();
    info_ = {.codec = "tiff",
             .width_px = static_cast<int>(page_.width_px),
             .height_px = static_cast<int>(page_.height_px),
             .channels = page_.stored >= 3 ? 3 : 1,
             .bits = page_.bits};
    std::uint16_t orientation = ORIENTATION_TOPLEFT;
    if (TIFFGetField(tiff_.get(), TIFFTAG_ORIENTATION, &orientation) == 1 && orientation >= 1 &&
        orientation <= 8)
      info_.orientation = orientation;
    constexpr double kMostPerByte = 1400.0;  // LZW with codes of 12 bits; deflate reaches 1032
    file_->check_size(page_.width_px, page_.height_px, page_.stored, page_.bits, kMostPerByte);
    info_.pages = TIFFNumberOfDirectories(tiff_.get());
    if (info_.pages == 0) file_->fail("is a TIFF without an image; write it again");
  }
  [[nodiscard]] const ImageInfo& info() const override { return info_; }
  [[nodiscard]] RasterImage read(std::size_t page) override {
    if (TIFFSetDirectory(tiff_.get(), static_cast<tdir_t>(page)) == 0)
      file_->fail(fmt::format("has a damaged page {}; copy it again", page));
    if (!(described_page() == page_)) {
      file_->fail(
          fmt::format("has pages of different sizes or types: page {} differs from page 0; "
                      "save each as a file",
                      page));
    }
    if (page_.format == SAMPLEFORMAT_IEEEFP) return {decode<float>(), info_.channels};
    if (page_.bits == 16) return {decode<std::uint16_t>(), info_.channels};
    return {decode<std::uint8_t>(), info_.channels};
  }

 private:
  /// The current page, of a kind that can be decoded.
  [[nodiscard]] TiffPage described_page() const {
    TIFF* const tiff = tiff_.get();
    TiffPage page;
    std::uint16_t planar = PLANARCONFIG_CONTIG;
    std::uint16_t compression = COMPRESSION_NONE;
    TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &page.width_px);
    TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &page.height_px);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &page.bits);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &page.stored);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &page.format);
    TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &page.photometric);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_PLANARCONFIG, &planar);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_COMPRESSION, &compression);
    constexpr std::array<std::uint16_t, 6> kLossless = {COMPRESSION_NONE,
                                                        COMPRESSION_LZW,
                                                        COMPRESSION_ADOBE_DEFLATE,
                                                        COMPRESSION_DEFLATE,
                                                        COMPRESSION_PACKBITS,
                                                        COMPRESSION_ZSTD};
    const bool lossless =
        std::find(kLossless.begin(), kLossless.end(), compression) != kLossless.end();
    if (!lossless || TIFFIsCODECConfigured(compression) == 0) {
      file_->fail(fmt::format(
          "is a TIFF with compression {}; save it without compression, or with LZW or deflate",
          compression));
    }
    const bool whole = page.format == SAMPLEFORMAT_UINT && (page.bits == 8 || page.bits == 16);
    const bool floating = page.format == SAMPLEFORMAT_IEEEFP && page.bits == 32;
    if (!whole && !floating) {
      file_->fail(
          fmt::format("is a TIFF of {}-bit samples of type {}; save it with 8 or 16 bits "
                      "or as 32-bit floating point",
                      page.bits,
                      page.format));
    }
    if (TIFFIsTiled(tiff) != 0) file_->fail("is a tiled TIFF; save it in strips");
    if (planar != PLANARCONFIG_CONTIG && page.stored > 1)
      file_->fail("is a TIFF with separate planes of colour; save it with interleaved samples");
    const bool grey = page.photometric == PHOTOMETRIC_MINISBLACK ||
                      (page.photometric == PHOTOMETRIC_MINISWHITE && !floating);
    if (!(grey && page.stored <= 2) &&
        !(page.photometric == PHOTOMETRIC_RGB && (page.stored == 3 || page.stored == 4))) {
      file_->fail(
          fmt::format("is a TIFF of {} samples per pixel and photometric interpretation "
                      "{}; save it as grey or as red, green and blue",
                      page.stored,
                      page.photometric));
    }
    return page;
  }

  template <typename T>
  [[nodiscard]] Image<T> decode() const {
    Image<T> image(info_.width_px * page_.stored, info_.height_px, Uninitialized{});
    const auto row_bytes = static_cast<tmsize_t>(sizeof(T)) * image.width();
    if (TIFFScanlineSize(tiff_.get()) != row_bytes) file_->fail("is a damaged TIFF; copy it again");
    for (int y = 0; y < image.height(); ++y) {
      if (TIFFReadScanline(tiff_.get(), &image(0, y), static_cast<std::uint32_t>(y), 0) != 1)
        file_->fail(fmt::format("is truncated or damaged at row {}; copy it again", y));
    }
    if constexpr (!std::is_floating_point_v<T>) {
      if (page_.photometric == PHOTOMETRIC_MINISWHITE) {
        for (T& sample : image.pixels())
          sample = static_cast<T>(~sample);
      }
    }
    return without_alpha(std::move(image), page_.stored, info_.channels);
  }

  std::shared_ptr<const ImageBytes> file_;
  TiffStream stream_;
  struct Close {
    void operator()(TIFF* tiff) const { TIFFClose(tiff); }
  };
  std::unique_ptr<TIFF, Close> tiff_;
  TiffPage page_;
  ImageInfo info_;
};

}  // namespace

std::unique_ptr<ImageDecoder> open_tiff(std::shared_ptr<const ImageBytes> file) {
  using namespace std::string_view_literals;
  const std::string_view begin(file->bytes.data(), std::min<std::size_t>(file->bytes.size(), 4));
  if (begin != "II*\0"sv && begin != "MM\0*"sv && begin != "II+\0"sv && begin != "MM\0+"sv)
    return nullptr;
  return std::make_unique<TiffDecoder>(std::move(file));
}

}  // namespace frangia
