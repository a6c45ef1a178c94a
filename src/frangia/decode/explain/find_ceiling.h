#pragma once

#include <optional>
#include <span>

#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"

namespace frangia {

/// A level below the white level at which the frames are cut off.
struct Ceiling {
  int counts = 0;         ///< the level, which no pixel exceeds
  double share = 0.0;     ///< of the samples that lie at it
  double log_odds = 0.0;  ///< natural logarithm, against frames that happen to end there
};

/// Looks for the level at which the frames of a camera are cut off although their white level is
/// higher: video levels end at 235 or 240, and frames of 8 bits may be stored with 16.
///
/// The camera's noise spreads the brightest pixels over several levels. A level that no pixel
/// exceeds and that holds four times as many as any of those below it is a ceiling.
///
/// @shape    all stacks of one view
/// @missing  nothing where the noise is too low to tell, or pixels reach the white level
[[nodiscard]] std::optional<Ceiling> find_ceiling(std::span<const FrameStack> stacks,
                                                  const NoiseModel& noise);

}  // namespace frangia
