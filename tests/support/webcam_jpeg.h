#pragma once

#include <cstdint>
#include <cstdio>  // jpeglib.h needs FILE
#include <cstdlib>
#include <functional>
#include <vector>

#include <jpeglib.h>

namespace frangia::testing {

/// A JPEG as webcams send it: YCbCr with half the colour along the rows, without Huffman tables.
inline std::vector<std::uint8_t> webcam_jpeg(
    int width, int height, int quality, const std::function<std::uint8_t(int x, int y)>& grey) {
  jpeg_compress_struct codec{};
  jpeg_error_mgr errors{};
  codec.err = jpeg_std_error(&errors);
  jpeg_create_compress(&codec);
  unsigned char* memory = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&codec, &memory, &size);
  codec.image_width = static_cast<JDIMENSION>(width);
  codec.image_height = static_cast<JDIMENSION>(height);
  codec.input_components = 3;
  codec.in_color_space = JCS_YCbCr;
  jpeg_set_defaults(&codec);
  codec.comp_info[0].v_samp_factor = 1;
  jpeg_set_quality(&codec, quality, TRUE);
  jpeg_start_compress(&codec, TRUE);
  std::vector<std::uint8_t> row(static_cast<std::size_t>(width) * 3, 128);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x)
      row[static_cast<std::size_t>(x) * 3] = grey(x, y);
    JSAMPROW rows = row.data();
    jpeg_write_scanlines(&codec, &rows, 1);
  }
  jpeg_finish_compress(&codec);
  jpeg_destroy_compress(&codec);
  // Copies all segments but those of Huffman tables.
  constexpr std::uint8_t kHuffman = 0xC4;
  constexpr std::uint8_t kScan = 0xDA;
  std::vector<std::uint8_t> bytes(memory, memory + 2);
  std::size_t at = 2;
  while (memory[at + 1] != kScan) {
    const std::size_t length = 2 + (std::size_t{memory[at + 2]} << 8U) + memory[at + 3];
    if (memory[at + 1] != kHuffman) bytes.insert(bytes.end(), memory + at, memory + at + length);
    at += length;
  }
  bytes.insert(bytes.end(), memory + at, memory + size);
  std::free(memory);  // NOLINT: libjpeg's buffer is the caller's
  return bytes;
}

}  // namespace frangia::testing
