#pragma once

#include "frangia/views/view.h"

namespace frangia {

/// Puts the pixels recovered at the edges of a view among the others.
void add_edge_pixels(View& view);

}  // namespace frangia
