#pragma once

#include "frangia/frames/frame_stack.h"
#include "frangia/phase/blur/find_sharpening.h"

namespace frangia {

/// The frames before an unsharp mask: exactly, up to the rounding to counts, since a mask weakens
/// no part of the spectrum. Pixels that it cut off at 0 or at white keep what was cut off.
///
/// @shape    frames of the same size and depth; saturated pixels stay saturated
[[nodiscard]] FrameStack without_sharpening(const FrameStack& stack,
                                            const CameraSharpening& sharpening);

}  // namespace frangia
