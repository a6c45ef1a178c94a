#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "frangia/core/image.h"
#include "frangia/core/memory_budget.h"

namespace frangia {

/// The samples of an image in the type that the file holds.
using Samples = std::variant<Image<std::uint8_t>, Image<std::uint16_t>, Image<float>>;

/// An image of any program: grey, or red, green and blue.
struct RasterImage {
  Samples samples;   ///< `channels` samples per pixel, side by side
  int channels = 1;  ///< 1 (grey) or 3 (red, green, blue)

  /// Returns the number of columns of pixels.
  [[nodiscard]] int width_px() const {
    return std::visit([](const auto& image) { return image.width(); }, samples) / channels;
  }
  /// Returns the number of rows of pixels.
  [[nodiscard]] int height_px() const {
    return std::visit([](const auto& image) { return image.height(); }, samples);
  }
};

/// The pages of an image file and how they are stored.
struct ImageInfo {
  std::string codec;      ///< "png", "tiff", "bmp", "jpeg", "pnm", "npy" or "raw"
  std::size_t pages = 1;  ///< images in the file, all of the size and type below
  int width_px = 0;       ///< columns of a page
  int height_px = 0;      ///< rows of a page
  int channels = 1;       ///< 1 (grey) or 3 (red, green, blue)
  int bits = 8;           ///< of a sample in memory: 8, 16, or 32 for floating point
  int white_level = 0;    ///< largest value that the file states as possible; 0: none stated
  std::optional<int> jpeg_quality{};  ///< 1 to 100, of a JPEG
  /// How the image is to be shown: the orientation of EXIF and TIFF, 1 to 8; 1: as it is stored.
  int orientation = 1;
};

/// The layout of a file that holds nothing but samples, grey and row by row.
struct RawFormat {
  int width_px = 0;            ///< columns
  int height_px = 0;           ///< rows
  int bits = 8;                ///< of a sample, 8 to 16; more than 8 take two bytes
  bool is_big_endian = false;  ///< the first of two bytes is the high one
};

/// Reads a raw layout such as "1280x1024x12le": width, height, bits and the order of the bytes,
/// which is "le" unless stated.
///
/// @errors   Error(Input) that names the text
[[nodiscard]] RawFormat parse_raw_format(const std::string& text);

/// How image files are read.
struct ImageFileOptions {
  std::optional<RawFormat> raw;  ///< set: every file holds samples in this layout
  std::uint64_t allow_memory_bytes = kAllowMemoryBytes;  ///< memory that a small file may take
};

/// A decoder of one format; see `ImageFile`.
class ImageDecoder {
 public:
  ImageDecoder() = default;
  ImageDecoder(const ImageDecoder&) = delete;
  ImageDecoder& operator=(const ImageDecoder&) = delete;
  ImageDecoder(ImageDecoder&&) = delete;
  ImageDecoder& operator=(ImageDecoder&&) = delete;
  virtual ~ImageDecoder() = default;
  /// The pages and how they are stored.
  [[nodiscard]] virtual const ImageInfo& info() const = 0;
  /// Decodes one page.
  [[nodiscard]] virtual RasterImage read(std::size_t page) = 0;
};

/// An open image file of another program. The first bytes decide the format, not the name.
///
/// PNG of any kind; TIFF of 8 and 16 bits and of 32-bit floating point, in strips, without lossy
/// compression; BMP; JPEG of 8 bits; PGM and PPM, binary and as text; NumPy's NPY with the shapes
/// (h, w), (n, h, w), (h, w, 3) and (n, h, w, 3); raw samples. Alpha channels are dropped.
///
/// @units    counts, as in the file; integers of NPY that fit into 16 bits become 16-bit samples
/// @errors   Error(Input) that names the file: missing, not an image, an unsupported kind, pages
///          that differ in size or type, damaged or truncated, or more memory than allowed
class ImageFile {
 public:
  /// Reads the file and its header.
  explicit ImageFile(const std::filesystem::path& path, const ImageFileOptions& options = {});

  /// The pages and how they are stored.
  [[nodiscard]] const ImageInfo& info() const { return decoder_->info(); }
  /// Decodes one page, from 0.
  [[nodiscard]] RasterImage read(std::size_t page = 0) const { return decoder_->read(page); }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }    ///< size of the file
  [[nodiscard]] std::uint32_t crc32() const { return crc32_; }  ///< CRC-32 of the whole file

 private:
  std::unique_ptr<ImageDecoder> decoder_;
  std::size_t bytes_ = 0;
  std::uint32_t crc32_ = 0;
};

/// Whether a file name ends like those of the formats that `ImageFile` reads.
[[nodiscard]] bool has_image_extension(const std::filesystem::path& path);

}  // namespace frangia
