#pragma once

#include <optional>
#include <span>
#include <vector>

#include "frangia/core/run.h"
#include "frangia/decode/decode_view.h"
#include "frangia/frames/frame_stack.h"
#include "frangia/phase/algorithm/fit_algorithm.h"
#include "frangia/phase/waveform/fringe_response.h"

namespace frangia {

/// Whether the harmonics that the frames show are corrected.
[[nodiscard]] bool undoes_own_response(const DecodeOptions& options);

/// The correction of the projector's response for the phase of a pattern, if the options ask for
/// one.
[[nodiscard]] std::optional<ResponseTable> correction_of(const Pattern& pattern,
                                                         const FittedAlgorithm& of_frames,
                                                         const DecodeOptions& options);

/// Fits the algorithms for the frames of all patterns, which share their waveforms.
[[nodiscard]] std::vector<FittedAlgorithm> fit_all(std::span<const FrameStack* const> fringes,
                                                   const NoiseModel& noise,
                                                   const DecodeOptions& options,
                                                   const Run& run);

/// Appends the wrapped phase and the frame assessment of one pattern to `out`.
void wrap_pattern(const FrameStack& taken,
                  const FittedAlgorithm& fitted,
                  const DecodeOptions& options,
                  const Run& run,
                  DecodedDirection& out);

}  // namespace frangia
