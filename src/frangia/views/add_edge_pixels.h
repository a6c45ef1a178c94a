#pragma once

#include "frangia/views/view.h"

namespace frangia {

/// Moves the recovered edge pixels of a view into its range grid.
void add_edge_pixels(View& view);

}  // namespace frangia
