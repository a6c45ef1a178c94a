#pragma once

#include <span>

#include "frangia/core/image.h"
#include "frangia/decode/decode_view.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/frames/png.h"

namespace frangia {

/// Returns the color of each pixel of a view as a screen shows it (sRGB): that of the frame of kind
/// white less the one of kind ambient. Without a white frame it is that of a coloured ambient one,
/// or else, in grey, the mean of the fringes, or of the brightest and the darkest frame of a Gray
/// code, less the ambient frame.
///
/// @shape    w x h as the frames
/// @missing  empty when `colors` is None, or no such frame exists
[[nodiscard]] Image<Rgb> view_color(std::span<const FrameStack> stacks, FrameColors colors);

}  // namespace frangia
