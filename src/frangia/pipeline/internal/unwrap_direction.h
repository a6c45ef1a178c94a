#pragma once

#include <span>

#include <Eigen/Core>

#include "frangia/core/image.h"
#include "frangia/core/run.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/pipeline/decode_view.h"
#include "frangia/rig/rig.h"

namespace frangia {

/// What decides the fringe orders of one direction of a view.
struct UnwrapInput {
  std::span<const FrameStack> stacks;  ///< all of the view; one may hold the laser sheet
  std::span<const FrameStack> gray;    ///< the Gray code of the direction, or empty
  const Rig& rig;
  const Image<Eigen::Vector2f>& rays;
  bool unwraps_temporally = false;  ///< the coarsest pattern is absolute
};

/// Turns the wrapped maps of one direction into its absolute phase: by the caller's own function,
/// by Gray code, by temporal unwrapping, by the beats of the patterns, or spatially with fringe
/// orders from the laser sheet or the distance. A new method of unwrapping gets its case here.
///
/// Reads `out.wrapped`, coarse to fine; writes `phase`, `relative`, `unresolved`, `profile` and
/// `checks`. Temporal unwrapping uses up the maps unless `keep_maps`.
void unwrap_direction(const UnwrapInput& input,
                      const DecodeOptions& options,
                      const Run& run,
                      DecodedView& out);

}  // namespace frangia
