#pragma once

#include <span>

#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"
#include "frangia/phase/phase_algorithm.h"
#include "frangia/phase/phase_map.h"
#include "frangia/phase/unwrap_temporally.h"
#include "frangia/phase/wrap_phase.h"
#include "frangia/rig/projector.h"

namespace frangia {

/// The frames of one map of a sequence, and the algorithm for them.
struct SequenceFrames {
  const FrameStack* stack = nullptr;
  PhaseAlgorithm algorithm;
};

struct SequenceOptions {
  WrapOptions wrap;
  TemporalUnwrapOptions temporal;
};

/// `wrap_phase` of every map and `unwrap_sequence` in one pass over the frames: the maps between
/// live in the cache only, which is what the time goes into.
///
/// `recycled` is a phase that is no longer needed: of the same size, its memory is written over.
/// shape    coarse to fine, all frames w x h
/// missing  as `wrap_phase` and `unwrap_sequence`
/// errors   Error(Input) as theirs
[[nodiscard]] AbsolutePhase decode_sequence(std::span<const SequenceFrames> coarse_to_fine,
                                            const NoiseModel& noise,
                                            const Projector& projector,
                                            const SequenceOptions& options = {},
                                            AbsolutePhase recycled = {});

}  // namespace frangia
