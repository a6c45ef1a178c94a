#pragma once

#include <span>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/pattern/pattern.h"
#include "frangia/simulate/internal/simulated_scene.h"

namespace frangia {

/// Renders the frames of all patterns at one station of the turntable.
///
/// Noise depends only on seed, view, pattern name, frame and pixel, not on the number of threads or
/// the other patterns.
/// @shape    one stack per pattern and exposure, in order; frames of the camera's size, 8 or 16 bit
/// @errors   Error(Input) when the rig cannot show a pattern
[[nodiscard]] std::vector<FrameStack> render_view(const SimulatedScene& scene,
                                                  std::span<const Pattern> patterns,
                                                  const SimulatedView& view,
                                                  const Run& run = {});

}  // namespace frangia
