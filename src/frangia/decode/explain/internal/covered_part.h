#pragma once

#include <optional>

#include "frangia/decode/explain/frame_hypothesis.h"
#include "frangia/decode/explain/internal/frame_sample.h"
#include "frangia/decode/explain/internal/score_frames.h"
#include "frangia/pattern/pattern.h"

namespace frangia {

/// A hypothesis about a part of the image, and its score.
struct CoveredPart {
  FrameHypothesis hypothesis;
  FrameScore score;
};

/// The part of the image where some frames show something else, while all of them agree in the rest
/// of it. It names the frames where they are a hundred times as likely as others; that takes
/// frames that leave a residual without them, or other patterns that tell the light of the pixels.
/// Blocks whose neighbours are covered are likely to be, too: the part is one region or a few. A
/// single frame that shows something else in most of the image is lost.
///
/// @missing  none where the blocks that disagree are few or most of them
[[nodiscard]] std::optional<CoveredPart> find_covered_part(const FrameSample& sample,
                                                           const Pattern& pattern);

}  // namespace frangia
