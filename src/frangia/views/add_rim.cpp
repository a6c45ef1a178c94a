#include "frangia/views/add_rim.h"

namespace frangia {

void add_rim(View& view) {
  for (const RangePixel& pixel : view.rim) {
    view.range.depth_mm.pixels()[pixel.pixel] = pixel.depth_mm;
    view.range.sigma_mm.pixels()[pixel.pixel] = pixel.sigma_mm;
  }
  view.rim.clear();
}

}  // namespace frangia
