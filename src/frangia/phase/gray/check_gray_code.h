#pragma once

#include "frangia/frames/frame_stack.h"
#include "frangia/phase/temporal/check_sequence.h"
#include "frangia/phase/wrap/phase_map.h"

namespace frangia {

/// Limits and sampling of `check_gray_code`.
struct GrayCodeCheckOptions {
  int lines = 64;  ///< sampled rows, or columns for horizontal stripes
  /// Distance of a bright or dark pixel from the mean of the fringes, over their modulation; pixels
  /// nearer to it are on the border of two stripes.
  double min_level = 0.3;
  std::size_t min_pixels = 300;  ///< fewer decide nothing
  std::size_t min_borders = 12;  ///< borders of a frame's stripes; fewer say nothing about it
  double margin_rad = 0.5;       ///< added to half a stripe when stripes are compared with fringes
  /// Shares of pixels that agree with the fringes, and of borders that lie between neighbouring
  /// stripes, below which the code does not fit. Sound codes have more than 0.95 of both, except
  /// for borders at depth edges.
  double min_agreement = 0.75;
  double min_gain = 0.2;  ///< by which another declaration must raise the smaller share
  double tie = 0.03;      ///< shares that differ by less are equal
  /// Start of the fringes at the borders of the stripes that a sound code may show: blur and
  /// harmonics move borders and phases. Half a projector pixel is 0.2 for fringes of 16 px.
  double max_start_rad = 0.25;
  double max_start_three_rad = 0.45;  ///< the same for three frames, which harmonics affect more
};

/// Compares a Gray or binary code with the fringes, and its stripes with their neighbours.
///
/// At the border of two stripes the number changes by one; a frame in another place, inverted or
/// missing breaks this rule at the borders of its stripes. The number also gives the phase of the
/// fringes to within half a stripe. Other orders of the frames, inversions, codes and starts of the
/// fringes are tried.
///
/// @shape    `gray` and `fringes` of one size and direction; one exposure
/// @missing  not decided for too few pixels on which all frames are bright or dark
/// @errors   Error(Input) when the number of frames differs from the pattern
[[nodiscard]] SequenceCheck check_gray_code(const FrameStack& gray,
                                            const WrappedPhase& fringes,
                                            const GrayCodeCheckOptions& options = {});

}  // namespace frangia
