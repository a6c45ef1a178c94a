#include "frangia/views/add_edge_pixels.h"

namespace frangia {

void add_edge_pixels(View& view) {
  for (const RangePixel& pixel : view.edge_pixels) {
    view.range.depth_mm(pixel.x, pixel.y) = pixel.depth_mm;
    view.range.sigma_mm(pixel.x, pixel.y) = pixel.sigma_mm;
  }
  view.edge_pixels.clear();
}

}  // namespace frangia
