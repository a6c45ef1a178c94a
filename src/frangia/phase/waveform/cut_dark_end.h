#pragma once

#include <optional>
#include <span>
#include <vector>

#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"

namespace frangia {

/// A level at which the camera cuts the dark end of the fringes off: 0 where its black level is too
/// low, or the black of video levels.
struct CutDarkEnd {
  int counts = 0;             ///< the level, below which no pixel is
  double share = 0.0;         ///< of the samples of pixels with fringes that lie at it
  double depth_counts = 0.0;  ///< how far below it the fringes reach at 95 % of these samples
  double least_counts = 0.0;  ///< the same at 99.5 %
  /// The mean A of the fringes as a function of their modulation B on the part: A = slope B +
  /// offset.
  double slope = 0.0;
  double offset_counts = 0.0;  ///< of that line; negative where the black level is too low
  double scatter = 0.0;        ///< standard deviation of A about it, over B; 0: not known
};

/// Looks for a level at which the samples of fringes pile up, although the fringes through the
/// other samples of the same pixels reach below it.
///
/// Full contrast in a dark room, the flat end of fringes by a display of high gamma and that of
/// square ones leave many samples near 0, too, but never four times as many at a level as in a step
/// of the noise above it; and what is above it lies on no sines. Samples of a frame that is black
/// are far below what the others predict, not above.
///
/// @shape    all stacks of one view; nothing for patterns with several exposures
/// @missing  nothing where no such level is found
[[nodiscard]] std::optional<CutDarkEnd> find_cut_dark_end(std::span<const FrameStack> stacks,
                                                          const NoiseModel& noise);

/// Frames of a camera whose black level is higher, so that nothing is cut off.
struct RaisedFrames {
  std::vector<FrameStack> stacks;  ///< all counts and white levels are higher
  NoiseModel noise;                ///< at these counts
};

/// Replaces the samples that are cut off by those of the fringes through the other samples of their
/// pixels, and raises all counts so that they are positive.
///
/// The fringe of a pixel is that of least squares through the samples above the level, and through
/// those at it which it would put above. Where fewer than three are left, the mean follows from the
/// modulation as elsewhere on the part: its scatter is part of the noise. `FrameStack::noise_gain`
/// is set to what the phase of the pixel lacks in precision; it is infinite where fewer than two
/// samples are left.
[[nodiscard]] RaisedFrames raise_dark_end(std::span<const FrameStack> stacks,
                                          const CutDarkEnd& cut,
                                          const NoiseModel& noise);

}  // namespace frangia
