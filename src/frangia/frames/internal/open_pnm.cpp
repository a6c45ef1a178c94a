#include <cctype>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "frangia/frames/internal/image_decoders.h"

namespace frangia {
namespace {

/// The numbers of a PGM or PPM file, with comments skipped.
class PnmText {
 public:
  PnmText(const ImageBytes& file, std::size_t at) : file_(&file), at_(at) {}

  /// The next number.
  [[nodiscard]] int number() {
    skip_space();
    long value = -1;
    for (; at_ < file_->bytes.size() && is_digit(file_->bytes[at_]); ++at_) {
      value = 10 * std::max(value, 0L) + (file_->bytes[at_] - '0');
      if (value > std::numeric_limits<int>::max()) file_->fail("holds a number that is too large");
    }
    if (value < 0) file_->fail("is truncated or damaged; copy it again");
    return static_cast<int>(value);
  }
  /// The position after the single blank that ends the header of a binary file.
  [[nodiscard]] std::size_t after_blank() const { return at_ + 1; }

 private:
  static bool is_digit(char letter) { return letter >= '0' && letter <= '9'; }
  void skip_space() {
    while (at_ < file_->bytes.size()) {
      if (file_->bytes[at_] == '#') {
        while (at_ < file_->bytes.size() && file_->bytes[at_] != '\n')
          ++at_;
      } else if (std::isspace(static_cast<unsigned char>(file_->bytes[at_])) == 0) {
        return;
      } else {
        ++at_;
      }
    }
  }

  const ImageBytes* file_;
  std::size_t at_;
};

class PnmDecoder : public ImageDecoder {
 public:
  explicit PnmDecoder(std::shared_ptr<const ImageBytes> file) : file_(std::move(file)) {
    const char kind = file_->bytes[1];
    is_text_ = kind == '2' || kind == '3';
    PnmText text(*file_, 2);
    info_ = {.codec = "pnm", .channels = kind == '3' || kind == '6' ? 3 : 1};
    info_.width_px = text.number();
    info_.height_px = text.number();
    info_.white_level = text.number();
    if (info_.white_level < 1 || info_.white_level > 65535) {
      file_->fail(fmt::format("states {} as its largest value; it must lie between 1 and 65535",
                              info_.white_level));
    }
    info_.bits = info_.white_level > 255 ? 16 : 8;
    data_ = text.after_blank();
    file_->check_size(static_cast<std::uint64_t>(info_.width_px),
                      static_cast<std::uint64_t>(info_.height_px),
                      info_.channels,
                      info_.bits,
                      /*most_per_byte=*/1.0);
    const std::size_t needed = static_cast<std::size_t>(info_.width_px) *
                               static_cast<std::size_t>(info_.height_px * info_.channels) *
                               static_cast<std::size_t>(info_.bits / 8);
    if (!is_text_ && data_ + needed > file_->bytes.size()) {
      file_->fail(fmt::format("is truncated: it has {} of {} bytes; copy it again",
                              file_->bytes.size(),
                              data_ + needed));
    }
  }
  [[nodiscard]] const ImageInfo& info() const override { return info_; }
  [[nodiscard]] RasterImage read(std::size_t /*page*/) override {
    if (info_.bits == 16) return {decode<std::uint16_t>(), info_.channels};
    return {decode<std::uint8_t>(), info_.channels};
  }

 private:
  template <typename T>
  [[nodiscard]] Image<T> decode() const {
    Image<T> image(info_.width_px * info_.channels, info_.height_px, Uninitialized{});
    PnmText text(*file_, data_);
    std::size_t at = data_;
    for (T& sample : image.pixels()) {
      int value = 0;
      if (is_text_) {
        value = text.number();
      } else {
        for (std::size_t i = 0; i < sizeof(T); ++i)
          value = 256 * value + static_cast<unsigned char>(file_->bytes[at++]);
      }
      if (value > info_.white_level) {
        file_->fail(fmt::format(
            "holds the value {}, above its largest value {}", value, info_.white_level));
      }
      sample = static_cast<T>(value);
    }
    return image;
  }

  std::shared_ptr<const ImageBytes> file_;
  ImageInfo info_;
  std::size_t data_ = 0;
  bool is_text_ = false;
};

}  // namespace

std::unique_ptr<ImageDecoder> open_pnm(std::shared_ptr<const ImageBytes> file) {
  const std::vector<char>& bytes = file->bytes;
  if (bytes.size() < 3 || bytes[0] != 'P' ||
      std::isspace(static_cast<unsigned char>(bytes[2])) == 0)
    return nullptr;
  if (bytes[1] != '2' && bytes[1] != '3' && bytes[1] != '5' && bytes[1] != '6') return nullptr;
  return std::make_unique<PnmDecoder>(std::move(file));
}

}  // namespace frangia
