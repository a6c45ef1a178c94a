#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "frangia/frames/frame_stack.h"

namespace frangia {

/// Frames each of which holds a share of the one before it.
struct FrameMixing {
  double share = 0.0;  ///< 0 to 1, of the frame before
  /// That frame as it was delivered, mixed itself: a camera that reduces noise over time. Otherwise
  /// as it was shown: an exposure that begins before the projector has switched.
  bool by_camera = false;
};

/// Looks for a share of the frame before in all frames of a view, in the order of their capture.
///
/// A share of a frame of the same pattern shifts its fringes and nothing else. The first frame of a
/// pattern holds fringes of another one, which leave a residual: that share w explains the residual
/// P I = w P I' of the frames I, with the projector P onto what no fringe explains and the
/// frames I' before them. It is found where it leaves much less of the residuals, in each pattern.
///
/// @shape    all stacks of one view, in the order in which they were captured
/// @missing  nothing without such a share, for fewer than two patterns of four frames or more, and
///           for patterns with several exposures
[[nodiscard]] std::optional<FrameMixing> find_frame_mixing(std::span<const FrameStack> stacks);

/// The frames without what they hold of those before. The first one of the view, whose predecessor
/// is unknown, stays as it is. Saturated pixels stay saturated.
[[nodiscard]] std::vector<FrameStack> without_mixing(std::span<const FrameStack> stacks,
                                                     const FrameMixing& mixing);

/// A sentence: "each frame holds 30 % of the one before it, ...".
[[nodiscard]] std::string describe(const FrameMixing& mixing);

}  // namespace frangia
