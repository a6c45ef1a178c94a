#pragma once

#include <span>

#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"
#include "frangia/phase/phase_map.h"
#include "frangia/phase/unwrap_temporally.h"

namespace frangia {

/// Absolute phase of fringes whose numbers Gray code tells.
///
/// A bit is read from a frame and its inverse, or from the frame and the fringes' own mean. The
/// stripe only has to lie within half a fringe of the phase: with stripes of half a fringe, one
/// that is read as its neighbour at an edge makes no difference. The chance of a wrong order is the
/// sum, over the bits that would change it, of the chance that the bit was misread, and of the
/// phase being that far off.
///
/// shape    `gray` holds the code, a stack an exposure, each w x h as `fringes`
/// missing  a pixel missing in `fringes`, or whose chance of a wrong order is over the limit
/// errors   Error(Input) when stripes are wider than a fringe, or of another size or direction
/// source   Sansoni, Carocci and Rodella 1999 for the half fringe
[[nodiscard]] AbsolutePhase decode_gray_code(std::span<const FrameStack> gray,
                                             const WrappedPhase& fringes,
                                             const NoiseModel& noise,
                                             const TemporalUnwrapOptions& options = {});

}  // namespace frangia
