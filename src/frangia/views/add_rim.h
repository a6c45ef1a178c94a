#pragma once

#include "frangia/views/view.h"

namespace frangia {

/// Puts the pixels of a view's rim among the others.
void add_rim(View& view);

}  // namespace frangia
