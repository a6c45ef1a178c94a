#pragma once

#include <span>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/pattern/pattern.h"
#include "frangia/simulate/internal/simulated_scene.h"

namespace frangia {

/// What the simulated camera sees of each pattern at one stop of the turntable.
///
/// Noise depends on the seed, the view, the pattern's name, the frame and the pixel only: the same
/// frames for any number of threads, and for any choice of patterns.
/// shape    a stack a pattern and exposure, in their order; frames of the camera's size, 8 bit or
/// 16 bit errors   Error(Input) when a pattern does not suit the rig: its projector cannot show it,
/// or a
///          line where the rig has none
[[nodiscard]] std::vector<FrameStack> render_view(const SimulatedScene& scene,
                                                  std::span<const Pattern> patterns,
                                                  const SimulatedView& view,
                                                  const Run& run = {});

}  // namespace frangia
