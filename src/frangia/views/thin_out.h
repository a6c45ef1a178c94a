#pragma once

#include "frangia/rig/lens.h"
#include "frangia/views/view.h"

namespace frangia {

/// Every `step`-th pixel of a camera, both ways, from the first on.
[[nodiscard]] Lens thin_out(const Lens& camera, int step);

/// The view that it has.
///
/// shape    as the thinned camera's
[[nodiscard]] View thin_out(const View& view, int step);

}  // namespace frangia
