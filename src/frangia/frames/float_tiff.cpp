#include "frangia/frames/float_tiff.h"

#include <memory>

#include <fmt/format.h>
#include <tiffio.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"

namespace frangia {

void write_float_tiff(const std::filesystem::path& path, const Image<float>& image) {
  AtomicFile file(path);
  bool written = true;
  {
    const std::unique_ptr<TIFF, decltype(&TIFFClose)> tiff(TIFFOpen(file.temporary().c_str(), "w"),
                                                           &TIFFClose);
    if (!tiff) {
      throw Error(ErrorKind::File, fmt::format("{}: cannot be written", path.string()));
    }
    const auto width = static_cast<std::uint32_t>(image.width());
    TIFFSetField(tiff.get(), TIFFTAG_IMAGEWIDTH, width);
    TIFFSetField(tiff.get(), TIFFTAG_IMAGELENGTH, static_cast<std::uint32_t>(image.height()));
    TIFFSetField(tiff.get(), TIFFTAG_BITSPERSAMPLE, 32);
    TIFFSetField(tiff.get(), TIFFTAG_SAMPLESPERPIXEL, 1);
    TIFFSetField(tiff.get(), TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_IEEEFP);
    TIFFSetField(tiff.get(), TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
    TIFFSetField(tiff.get(), TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    TIFFSetField(tiff.get(), TIFFTAG_ROWSPERSTRIP, TIFFDefaultStripSize(tiff.get(), 0));
    Image<float> copy = image;  // libtiff takes a non-const row
    for (int y = 0; y < image.height() && written; ++y) {
      written = TIFFWriteScanline(tiff.get(), &copy(0, y), static_cast<std::uint32_t>(y), 0) == 1;
    }
  }
  if (!written) {
    throw Error(ErrorKind::File,
                fmt::format("{}: the disk is full or failing; free some space", path.string()));
  }
  file.commit();
}

}  // namespace frangia
