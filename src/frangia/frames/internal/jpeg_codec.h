#pragma once

#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstdio>  // jpeglib.h needs FILE
#include <optional>

#include <jpeglib.h>

namespace frangia {

/// libjpeg's error manager, which returns to `jump` with the message.
struct JpegErrors {
  jpeg_error_mgr base{};
  std::jmp_buf jump{};
  std::array<char, JMSG_LENGTH_MAX> message{};
};

/// What libjpeg repairs with a warning.
enum class JpegDamage {
  Refused,       ///< every warning is an error
  StrayAllowed,  ///< surplus bytes between the parts, as webcams send them, are skipped
};

/// A libjpeg decompressor that is destroyed at the end.
struct JpegCodec {
  explicit JpegCodec(JpegDamage damage = JpegDamage::Refused);
  JpegCodec(const JpegCodec&) = delete;
  JpegCodec& operator=(const JpegCodec&) = delete;
  JpegCodec(JpegCodec&&) = delete;
  JpegCodec& operator=(JpegCodec&&) = delete;
  ~JpegCodec() { jpeg_destroy_decompress(&codec); }

  JpegErrors errors;
  jpeg_progress_mgr progress{};
  jpeg_decompress_struct codec{};
};

/// Reads the header; false with a message in `errors` if it cannot be read.
[[nodiscard]] bool read_jpeg_header(JpegCodec& jpeg, const unsigned char* bytes, std::size_t size);

/// Decodes into rows of `stride` bytes; false with a message in `errors` if the data are damaged.
[[nodiscard]] bool read_jpeg_rows(JpegCodec& jpeg,
                                  unsigned char* pixels,
                                  std::size_t stride,
                                  bool grey);

/// The quality, from the quantization table of the brightness; none without a table.
[[nodiscard]] std::optional<int> quality_of(const JpegCodec& jpeg);

}  // namespace frangia
