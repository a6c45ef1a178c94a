#include "frangia/frames/internal/jpeg_codec.h"

#include <jerror.h>

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

}  // namespace frangia
