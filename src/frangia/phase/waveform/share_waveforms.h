#pragma once

#include <span>

#include "frangia/phase/algorithm/fit_algorithm.h"

namespace frangia {

/// Gives each pattern the harmonics that its own frames do not determine, such as those of a single
/// fringe over the field in three frames, from the pattern of the nearest period that determines
/// them: they belong to the projector. Likewise gives each pattern whose frames do not determine
/// the effect of flicker the rms effect on the others of as many frames, as the light is the same.
///
/// @shape    one fit per pattern
void share_waveforms(std::span<FittedAlgorithm> fits);

}  // namespace frangia
