#include "frangia/frames/decode_mjpeg.h"

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/frames/internal/jpeg_codec.h"

namespace frangia {

MjpegFrame decode_mjpeg(std::span<const std::uint8_t> bytes, int width_px, int height_px) {
  const auto refuse = [](const std::string& why) {
    throw Error(ErrorKind::Input, "the JPEG " + why);
  };
  JpegCodec jpeg(JpegDamage::StrayAllowed);
  if (!read_jpeg_header(jpeg, bytes.data(), bytes.size()))
    refuse(fmt::format("cannot be read ({})", jpeg.errors.message.data()));
  const auto width = static_cast<int>(jpeg.codec.image_width);
  const auto height = static_cast<int>(jpeg.codec.image_height);
  if (width != width_px || height != height_px) {
    refuse(
        fmt::format("has {} x {} pixels instead of {} x {}", width, height, width_px, height_px));
  }
  const auto quality = quality_of(jpeg);
  if (!quality) refuse("has no quantization table");
  MjpegFrame frame{Image<std::uint8_t>(width, height, Uninitialized{}), *quality};
  // libjpeg-turbo sets the standard Huffman tables where a frame has none.
  if (!read_jpeg_rows(
          jpeg, frame.brightness.pixels().data(), static_cast<std::size_t>(width), true))
    refuse(fmt::format("is truncated or damaged ({})", jpeg.errors.message.data()));
  return frame;
}

}  // namespace frangia
