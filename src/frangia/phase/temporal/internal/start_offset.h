#pragma once

#include <vector>

#include "frangia/phase/temporal/internal/sequence_sample.h"
#include "frangia/phase/temporal/internal/sequence_trials.h"

namespace frangia {

/// The starts of single patterns that explain a disagreement of the phases which is the same all
/// over the image, though too small to be seen at one pixel: a start of the finest pattern that is
/// 37 degrees off moves its place by a tenth of a fringe only.
///
/// The residuals of each pattern are averaged over the image. Harmonics, noise and indirect light
/// differ from place to place; a start does not. Patterns that explain the averages equally well
/// are all returned.
[[nodiscard]] std::vector<SequenceTrial> trials_of_start_offset(const SequenceSample& sample);

}  // namespace frangia
