#pragma once

#include <optional>
#include <span>
#include <vector>

#include "frangia/frames/frame_stack.h"
#include "frangia/frames/noise_model.h"
#include "frangia/phase/algorithm/phase_algorithm.h"
#include "frangia/phase/temporal/unwrap_temporally.h"
#include "frangia/phase/waveform/fringe_response.h"
#include "frangia/phase/wrap/phase_map.h"
#include "frangia/phase/wrap/wrap_phase.h"
#include "frangia/rig/projector.h"

namespace frangia {

/// The frames of one map of a sequence and the algorithm that decodes them.
struct SequenceFrames {
  const FrameStack* stack = nullptr;  ///< frames of the pattern; must not be null
  PhaseAlgorithm algorithm;           ///< algorithm for the shifts of these frames
  /// Shifts that explain the frames by themselves equally well where those of the pattern do not;
  /// empty where these do.
  std::vector<std::vector<double>> orders_rad{};
  /// Phase error that the waveform of these frames makes; none if it is unknown.
  std::optional<double> systematic_rad{};
  /// What undoes the response of the projector, before a map is compared with what coarser ones
  /// predict: they predict their own errors as many times as large as their fringes are. Decoding
  /// does not apply it.
  std::optional<ResponseTable> correction{};
};

/// Options of the decoding of a multi-frequency sequence.
struct SequenceOptions {
  WrapOptions wrap;                ///< limit of the phase noise of each level
  TemporalUnwrapOptions temporal;  ///< limit of wrong fringe orders, and smoothing of coarse levels
};

/// Performs `wrap_phase` on every map and `unwrap_sequence` on the result in one pass over the
/// frames. Intermediate maps stay in the cache, because memory traffic dominates the time.
///
/// `recycled` is a phase that is no longer needed; its memory is reused if the size matches.
///
/// @shape    coarse to fine, all frames w x h
/// @missing  as `wrap_phase` and `unwrap_sequence`
/// @errors   Error(Input) as `wrap_phase` and `unwrap_sequence`
[[nodiscard]] AbsolutePhase decode_sequence(std::span<const SequenceFrames> coarse_to_fine,
                                            const NoiseModel& noise,
                                            const Projector& projector,
                                            const SequenceOptions& options = {},
                                            AbsolutePhase recycled = {});

}  // namespace frangia
