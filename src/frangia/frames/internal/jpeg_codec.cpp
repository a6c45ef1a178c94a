#include "frangia/frames/internal/jpeg_codec.h"

#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <jerror.h>

#include "frangia/frames/internal/exif_orientation.h"
#include "frangia/frames/internal/image_decoders.h"
#include "frangia/frames/jpeg_noise.h"

namespace frangia {
namespace {

void leave_libjpeg(j_common_ptr codec) {
  auto* const errors = reinterpret_cast<JpegErrors*>(codec->err);
  (*codec->err->format_message)(codec, errors->message.data());
  std::longjmp(errors->jump, 1);  // NOLINT(cert-err52-cpp): libjpeg's way out
}

void treat_warning_as_error(j_common_ptr codec, int level) {
  if (level < 0) leave_libjpeg(codec);
}

void skip_stray_bytes(j_common_ptr codec, int level) {
  if (level < 0 && codec->err->msg_code != JWRN_EXTRANEOUS_DATA) leave_libjpeg(codec);
}

/// Refuses progressive files of absurdly many scans, each of which passes over the whole image.
void limit_scans(j_common_ptr codec) {
  constexpr int kMaxScans = 100;
  auto* const decompress = reinterpret_cast<j_decompress_ptr>(codec);
  if (decompress->input_scan_number > kMaxScans) leave_libjpeg(codec);
}

}  // namespace

JpegCodec::JpegCodec(JpegDamage damage) {
  codec.err = jpeg_std_error(&errors.base);
  errors.base.error_exit = leave_libjpeg;
  errors.base.emit_message =
      damage == JpegDamage::StrayAllowed ? skip_stray_bytes : treat_warning_as_error;
  progress.progress_monitor = limit_scans;
}

// No object with a destructor lives across the jumps.
bool read_jpeg_header(JpegCodec& jpeg, const unsigned char* bytes, std::size_t size) {
  if (setjmp(jpeg.errors.jump) != 0) return false;  // NOLINT(cert-err52-cpp)
  jpeg_create_decompress(&jpeg.codec);
  jpeg.codec.progress = &jpeg.progress;
  jpeg_mem_src(&jpeg.codec, bytes, size);
  jpeg_read_header(&jpeg.codec, TRUE);
  return true;
}

bool read_jpeg_rows(JpegCodec& jpeg, unsigned char* pixels, std::size_t stride, bool grey) {
  if (setjmp(jpeg.errors.jump) != 0) return false;  // NOLINT(cert-err52-cpp)
  jpeg.codec.out_color_space = grey ? JCS_GRAYSCALE : JCS_RGB;
  jpeg.codec.dct_method = JDCT_ISLOW;
  jpeg_start_decompress(&jpeg.codec);
  while (jpeg.codec.output_scanline < jpeg.codec.output_height) {
    JSAMPROW row = pixels + stride * jpeg.codec.output_scanline;
    jpeg_read_scanlines(&jpeg.codec, &row, 1);
  }
  jpeg_finish_decompress(&jpeg.codec);
  return true;
}

std::optional<int> quality_of(const JpegCodec& jpeg) {
  const JQUANT_TBL* const table =
      jpeg.codec.quant_tbl_ptrs[jpeg.codec.comp_info[0].quant_tbl_no & 3];
  if (table == nullptr) return std::nullopt;
  std::array<int, 64> steps{};
  for (std::size_t i = 0; i < steps.size(); ++i)
    steps[i] = table->quantval[i];
  return jpeg_quality(steps);
}

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
