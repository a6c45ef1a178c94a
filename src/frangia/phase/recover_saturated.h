#pragma once

#include <cstddef>

#include "frangia/frames/frame_stack.h"

namespace frangia {

/// Four frames 90 degrees apart obey I1 + I3 = I2 + I4: where a single one is saturated, the three
/// others tell it. The frames become 16 bits deep, because what is recovered lies above white; a
/// pixel with more than one saturated frame stays saturated. Returns how many were recovered.
///
/// The recovered count holds three frames' noise: sigma of such a pixel is up to twice that told.
/// errors   Error(Input) unless there are four shifts 90 degrees apart
std::size_t recover_saturated(FrameStack& stack);

}  // namespace frangia
