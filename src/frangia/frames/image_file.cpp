#include "frangia/frames/image_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/checksums.h"
#include "frangia/core/error.h"
#include "frangia/core/read_file.h"
#include "frangia/frames/internal/image_decoders.h"

namespace frangia {
namespace {

/// Protects against sparse files.
constexpr std::size_t kMaxImageFileBytes = std::size_t{1} << 32U;

std::unique_ptr<ImageDecoder> decoder_of(const std::shared_ptr<const ImageBytes>& file,
                                         const ImageFileOptions& options) {
  if (options.raw) return open_raw(file, *options.raw);
  for (auto* const open : {open_png, open_tiff, open_bmp, open_jpeg, open_pnm, open_npy}) {
    if (auto decoder = open(file)) return decoder;
  }
  file->fail(
      "is not an image that can be imported: PNG, TIFF, BMP, JPEG, PGM, PPM, NPY; for bare samples "
      "set `raw`");
}

}  // namespace

void ImageBytes::fail(const std::string& what) const {
  throw Error(ErrorKind::Input, fmt::format("{}: {}", path.string(), what));
}

void ImageBytes::check_size(std::uint64_t width_px,
                            std::uint64_t height_px,
                            int channels,
                            int bits,
                            double most_per_byte) const {
  constexpr std::uint64_t kMaxSide = 65535;
  constexpr double kMaxPixels = 250e6;  // as for the frames of a scan
  const double pixels = static_cast<double>(width_px) * static_cast<double>(height_px);
  if (width_px == 0 || height_px == 0) fail("holds an image of no pixels; write it again");
  if (width_px > kMaxSide || height_px > kMaxSide || pixels > kMaxPixels) {
    fail(
        fmt::format("has {} x {} pixels, more than the 65535 a side and {:.0f} million of the "
                    "largest frame",
                    width_px,
                    height_px,
                    kMaxPixels / 1e6));
  }
  const double samples = pixels * channels;
  if (samples > most_per_byte * static_cast<double>(bytes.size())) {
    fail(
        fmt::format("is truncated or damaged: its {} bytes cannot hold {} x {} pixels; copy it "
                    "again",
                    bytes.size(),
                    width_px,
                    height_px));
  }
  MemoryBudget(path, bytes.size(), allow_memory_bytes).check(samples * bits / 8);
}

ImageFile::ImageFile(const std::filesystem::path& path, const ImageFileOptions& options) {
  auto file = std::make_shared<ImageBytes>();
  file->path = path;
  file->bytes = read_regular_file(path, kMaxImageFileBytes);
  file->allow_memory_bytes = options.allow_memory_bytes;
  if (file->bytes.empty()) file->fail("is an empty file of 0 bytes; copy it again");
  bytes_ = file->bytes.size();
  crc32_ = frangia::crc32(file->bytes);
  decoder_ = decoder_of(file, options);
}

bool has_image_extension(const std::filesystem::path& path) {
  constexpr std::array<std::string_view, 11> kKnown = {
      ".png", ".tif", ".tiff", ".bmp", ".jpg", ".jpeg", ".pgm", ".ppm", ".pnm", ".npy", ".raw"};
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char letter) {
    return static_cast<char>(std::tolower(letter));
  });
  return std::find(kKnown.begin(), kKnown.end(), extension) != kKnown.end();
}

RawFormat parse_raw_format(const std::string& text) {
  const auto refuse = [&] {
    throw Error(ErrorKind::Input,
                fmt::format("`raw` is \"{}\"; write WIDTHxHEIGHTxBITS with 8 to 16 bits, then le "
                            "or be, such as 1280x1024x12le",
                            text));
  };
  std::string_view rest = text;
  RawFormat format;
  if (rest.ends_with("le") || rest.ends_with("be")) {
    format.is_big_endian = rest.ends_with("be");
    rest.remove_suffix(2);
  }
  const std::array<int*, 3> numbers = {&format.width_px, &format.height_px, &format.bits};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), *numbers[i]);
    if (error != std::errc{} || end == rest.data()) refuse();
    rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
    if (i + 1 == numbers.size()) break;
    if (!rest.starts_with('x')) refuse();
    rest.remove_prefix(1);
  }
  const auto is_side = [](int side) { return side >= 1 && side <= 65535; };
  if (!rest.empty() || !is_side(format.width_px) || !is_side(format.height_px) || format.bits < 8 ||
      format.bits > 16)
    refuse();
  return format;
}

}  // namespace frangia
