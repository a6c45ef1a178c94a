#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "frangia/frames/internal/image_decoders.h"

namespace frangia {
namespace {

/// The value of a key in the header of an NPY file, which is a Python dictionary on one line.
std::string_view npy_value(std::string_view header, std::string_view key) {
  const std::size_t found = header.find(fmt::format("'{}':", key));
  if (found == std::string_view::npos) return {};
  std::string_view rest = header.substr(found + key.size() + 3);
  rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
  if (rest.starts_with('(')) return rest.substr(0, rest.find(')'));
  return rest.substr(0, rest.find(','));
}

/// The numbers of a shape such as "(12, 480, 640".
std::vector<std::uint64_t> npy_shape(std::string_view text) {
  std::vector<std::uint64_t> shape;
  while (!text.empty()) {
    std::uint64_t side = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), side);
    if (error == std::errc{}) {
      shape.push_back(side);
      text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    } else {
      text.remove_prefix(1);
    }
  }
  return shape;
}

template <typename T>
T npy_sample(const char* bytes, bool swap) {
  std::array<char, sizeof(T)> copy{};
  std::memcpy(copy.data(), bytes, sizeof(T));
  if (swap) std::reverse(copy.begin(), copy.end());
  return std::bit_cast<T>(copy);
}

/// @source   NumPy, format specification of NPY: numpy.lib.format
class NpyDecoder : public ImageDecoder {
 public:
  explicit NpyDecoder(std::shared_ptr<const ImageBytes> file) : file_(std::move(file)) {
    const std::string_view header = read_header();
    read_type(npy_value(header, "descr"));
    if (!npy_value(header, "fortran_order").starts_with("False"))
      file_->fail("is stored in Fortran order; save numpy.ascontiguousarray(frames)");
    read_shape(npy_shape(npy_value(header, "shape")));
  }
  [[nodiscard]] const ImageInfo& info() const override { return info_; }
  [[nodiscard]] RasterImage read(std::size_t page) override {
    const char* const begin = file_->bytes.data() + data_ + page * page_bytes_;
    const int columns = info_.width_px * stored_;
    switch (info_.bits) {
      case 8:
        return {as_image<std::uint8_t>(begin, columns), info_.channels};
      case 16:
        return {as_image<std::uint16_t>(begin, columns), info_.channels};
      default:
        return {as_image<float>(begin, columns), info_.channels};
    }
  }

 private:
  std::string_view read_header() {
    const std::vector<char>& bytes = file_->bytes;
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
    const bool is_old = bytes.size() >= 10 && byte(6) == 1;
    const std::size_t begin = is_old ? 10 : 12;
    std::size_t length = 0;
    if (bytes.size() > begin) {
      length = byte(8) | static_cast<std::size_t>(byte(9)) << 8U;
      if (!is_old)
        length |= static_cast<std::size_t>(byte(10)) << 16U | static_cast<std::size_t>(byte(11))
                                                                  << 24U;
    }
    if (length == 0 || begin + length > bytes.size())
      file_->fail("is a truncated NPY file; copy it again");
    data_ = begin + length;
    return {bytes.data() + begin, length};
  }

  void read_type(std::string_view text) {
    if (text.size() >= 2 && text.front() == '\'') text = text.substr(1, text.size() - 2);
    constexpr std::string_view kKinds = "uif";
    const bool known = text.size() == 3 && kKinds.find(text[1]) != std::string_view::npos;
    kind_ = known ? text[1] : '?';
    item_bytes_ = known ? static_cast<std::size_t>(text[2] - '0') : 0;
    const bool whole = item_bytes_ == 1 || item_bytes_ == 2 || item_bytes_ == 4 || item_bytes_ == 8;
    if (!known || !whole || (kind_ == 'f' && item_bytes_ < 4)) {
      file_->fail(fmt::format("holds values of type {}; save integers, float32 or float64",
                              text.substr(0, 40)));
    }
    swap_ = text[0] == '>';  // Debian's machines and NumPy's default are little-endian
    info_.codec = "npy";
    info_.bits = kind_ == 'f' ? 32 : (kind_ == 'u' && item_bytes_ == 1 ? 8 : 16);
  }

  void read_shape(const std::vector<std::uint64_t>& shape) {
    const bool colored = shape.size() >= 3 && (shape.back() == 3 || shape.back() == 4);
    const std::size_t plain = shape.size() - (colored ? 1 : 0);
    if (plain != 2 && plain != 3)
      file_->fail("has a shape that is not (h, w), (n, h, w), (h, w, 3) or (n, h, w, 3)");
    stored_ = colored ? static_cast<int>(shape.back()) : 1;
    info_.channels = colored ? 3 : 1;
    const std::uint64_t pages = plain == 3 ? shape[0] : 1;
    const std::uint64_t height_px = shape[plain - 2];
    const std::uint64_t width_px = shape[plain - 1];
    file_->check_size(width_px, height_px, stored_, info_.bits, /*most_per_byte=*/1.0);
    info_.width_px = static_cast<int>(width_px);
    info_.height_px = static_cast<int>(height_px);
    page_bytes_ = width_px * height_px * static_cast<std::uint64_t>(stored_) * item_bytes_;
    if (pages == 0 || pages > (file_->bytes.size() - data_) / page_bytes_) {
      file_->fail(
          fmt::format("is truncated: its {} bytes do not hold the {} frames of its shape; "
                      "copy it again",
                      file_->bytes.size(),
                      pages));
    }
    info_.pages = pages;
  }

  /// One value as a number.
  [[nodiscard]] double value_at(const char* at) const {
    if (kind_ == 'f')
      return item_bytes_ == 4 ? static_cast<double>(npy_sample<float>(at, swap_))
                              : npy_sample<double>(at, swap_);
    const bool is_signed = kind_ == 'i';
    switch (item_bytes_) {
      case 1:
        return is_signed ? npy_sample<std::int8_t>(at, swap_) : npy_sample<std::uint8_t>(at, swap_);
      case 2:
        return is_signed ? npy_sample<std::int16_t>(at, swap_)
                         : npy_sample<std::uint16_t>(at, swap_);
      case 4:
        return is_signed ? static_cast<double>(npy_sample<std::int32_t>(at, swap_))
                         : static_cast<double>(npy_sample<std::uint32_t>(at, swap_));
      default:
        return is_signed ? static_cast<double>(npy_sample<std::int64_t>(at, swap_))
                         : static_cast<double>(npy_sample<std::uint64_t>(at, swap_));
    }
  }

  template <typename T>
  [[nodiscard]] Image<T> as_image(const char* begin, int columns) const {
    Image<T> image(columns, info_.height_px, Uninitialized{});
    for (T& sample : image.pixels()) {
      const double value = value_at(begin);
      begin += item_bytes_;
      if constexpr (!std::is_floating_point_v<T>) {
        if (!(value >= 0.0 && value <= 65535.0)) {
          file_->fail(fmt::format(
              "holds the value {:.0f}; integers of frames must lie between 0 and 65535", value));
        }
      }
      sample = static_cast<T>(value);
    }
    return without_alpha(std::move(image), stored_, info_.channels);
  }

  std::shared_ptr<const ImageBytes> file_;
  ImageInfo info_;
  std::size_t data_ = 0;
  std::size_t item_bytes_ = 1;
  std::size_t page_bytes_ = 0;
  int stored_ = 1;
  char kind_ = 'u';
  bool swap_ = false;
};

}  // namespace

std::unique_ptr<ImageDecoder> open_npy(std::shared_ptr<const ImageBytes> file) {
  if (!std::string_view(file->bytes.data(), file->bytes.size()).starts_with("\x93NUMPY"))
    return nullptr;
  return std::make_unique<NpyDecoder>(std::move(file));
}

}  // namespace frangia
