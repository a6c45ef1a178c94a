#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "frangia/frames/image_file.h"

namespace frangia {

/// A file in memory.
struct ImageBytes {
  std::filesystem::path path;  ///< for messages
  std::vector<char> bytes;
  std::uint64_t allow_memory_bytes = kAllowMemoryBytes;

  /// Throws Error(Input) with "PATH: WHAT".
  [[noreturn]] void fail(const std::string& what) const;
  /// Refuses a size that no camera has, that the file cannot hold, or that takes more memory than
  /// allowed. `most_per_byte` is the largest number of samples that a byte of the file can hold.
  void check_size(std::uint64_t width_px,
                  std::uint64_t height_px,
                  int channels,
                  int bits,
                  double most_per_byte) const;
};

/// The decoder of a format; nullptr if the bytes begin otherwise. Each throws Error(Input) that
/// names the file for a file of its format that it cannot read.
[[nodiscard]] std::unique_ptr<ImageDecoder> open_png(std::shared_ptr<const ImageBytes> file);
[[nodiscard]] std::unique_ptr<ImageDecoder> open_tiff(std::shared_ptr<const ImageBytes> file);
[[nodiscard]] std::unique_ptr<ImageDecoder> open_bmp(std::shared_ptr<const ImageBytes> file);
[[nodiscard]] std::unique_ptr<ImageDecoder> open_jpeg(std::shared_ptr<const ImageBytes> file);
[[nodiscard]] std::unique_ptr<ImageDecoder> open_pnm(std::shared_ptr<const ImageBytes> file);
[[nodiscard]] std::unique_ptr<ImageDecoder> open_npy(std::shared_ptr<const ImageBytes> file);
/// The decoder of raw samples; it accepts any bytes of a fitting length.
[[nodiscard]] std::unique_ptr<ImageDecoder> open_raw(std::shared_ptr<const ImageBytes> file,
                                                     const RawFormat& format);

/// An image of `channels` from samples with `stored` of them per pixel, of which the others (alpha)
/// are dropped.
template <typename T>
[[nodiscard]] Image<T> without_alpha(Image<T> image, int stored, int channels) {
  if (stored == channels) return image;
  const int width_px = image.width() / stored;
  Image<T> kept(width_px * channels, image.height(), Uninitialized{});
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < width_px; ++x) {
      for (int c = 0; c < channels; ++c)
        kept(x * channels + c, y) = image(x * stored + c, y);
    }
  }
  return kept;
}

}  // namespace frangia
