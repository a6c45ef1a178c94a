#include "frangia/views/add_edge_pixels.h"

namespace frangia {

void add_edge_pixels(View& view) {
  for (const RangePixel& pixel : view.edge_pixels)
    view.range.set(pixel);
  view.edge_pixels.clear();
}

}  // namespace frangia
