#include "frangia/views/add_rim.h"

namespace frangia {

void add_rim(View& view) {
  for (const RangePixel& pixel : view.rim) {
    view.range.depth_mm(pixel.x, pixel.y) = pixel.depth_mm;
    view.range.sigma_mm(pixel.x, pixel.y) = pixel.sigma_mm;
  }
  view.rim.clear();
}

}  // namespace frangia
