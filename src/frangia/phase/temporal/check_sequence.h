#pragma once

#include <cstddef>
#include <span>

#include "frangia/frames/noise_model.h"
#include "frangia/phase/temporal/sequence_check.h"
#include "frangia/phase/wrap/decode_sequence.h"
#include "frangia/rig/projector.h"

namespace frangia {

/// Limits and sampling of `check_sequence`.
struct SequenceCheckOptions {
  std::size_t pixels = 60'000;   ///< sampled in whole rows
  std::size_t compared = 3000;   ///< sampled pixels whose distances are computed
  std::size_t rows = 24;         ///< in which the ends of the field are looked for
  std::size_t min_pixels = 300;  ///< fewer measured pixels decide nothing
  /// Misfit over chance above which patterns disagree. Sound scans, also real ones with harmonics
  /// of 0.2 rad, stay below 0.4; a wrong start of 90 degrees gives 0.55 and more
  /// (`./run figures sequence_faults`).
  double max_misfit = 0.5;
  /// The misfit of a declaration that fits, over that of scan.toml.
  double max_fitted = 0.6;
  /// Share of the rows in which the ends of the field may meet: at a depth edge that happens to
  /// show both.
  double max_split_rows = 0.25;
};

/// Compares the wrapped phases of the fringe patterns of one direction with each other.
///
/// All phases of a pixel belong to one place of the projector's field. The distance from the
/// nearest such combination is small if period, start, direction of shift and order of frames of
/// all patterns are those of scan.toml. If it is not, other declarations are tried, and those that
/// fit decisively better are returned.
///
/// Whether the frames of a pattern have its shifts is not asked here: `SequenceFrames::orders_rad`
/// holds what explains them, and the other patterns decide between equal explanations.
///
/// `determines_orders` states whether the patterns by themselves determine the absolute phase of
/// the finest one (`find_sequence_method`).
///
/// @shape    coarse to fine, all frames w x h
/// @missing  not decided for a single pattern with three frames, for too few measured pixels, and
///           where the phases of unrelated patterns would fit as well
[[nodiscard]] SequenceCheck check_sequence(std::span<const SequenceFrames> coarse_to_fine,
                                           const NoiseModel& noise,
                                           const Projector& projector,
                                           bool determines_orders,
                                           const WrapOptions& wrap = {},
                                           const SequenceCheckOptions& options = {});

}  // namespace frangia
