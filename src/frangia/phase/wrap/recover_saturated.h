#pragma once

#include <cstddef>

#include "frangia/frames/frame_stack.h"

namespace frangia {

/// Reconstructs single saturated counts. Four frames 90 degrees apart satisfy I1 + I3 = I2 + I4, so
/// three frames determine the fourth. The frames become 16 bits deep, because recovered counts
/// exceed the white level. A pixel with more than one saturated frame stays saturated. Returns the
/// number of recovered pixels.
///
/// The noise of a recovered count is that of three frames; sigma of such a pixel is up to twice the
/// reported value.
/// @errors   Error(Input) unless there are four shifts 90 degrees apart
std::size_t recover_saturated(FrameStack& stack);

}  // namespace frangia
