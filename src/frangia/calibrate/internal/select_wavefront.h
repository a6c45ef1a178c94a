#pragma once

#include <array>

#include "frangia/calibrate/internal/artifact_model.h"

namespace frangia {

/// Terms of the wavefront that the residuals of a fit call for, besides those that are estimated
/// already: the second order before the third; none when the residuals are noise.
///
/// @source   score test, Rao 1948, at the optimum without them
[[nodiscard]] std::array<bool, Wavefront::kTerms> missing_wavefront_terms(
    const ArtifactProblem& problem,
    const ArtifactNoise& noise,
    const ArtifactParameters& parameters);

}  // namespace frangia
