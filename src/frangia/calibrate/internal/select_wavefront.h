#pragma once

#include <array>

#include "frangia/calibrate/internal/artifact_model.h"

namespace frangia {

/// Returns the terms of the wavefront that would explain the residuals of a fit and are not yet
/// estimated: first the second order, then the third; none when the residuals are noise.
///
/// @source   score test, Rao 1948, at the optimum without them
[[nodiscard]] std::array<bool, Wavefront::kTerms> missing_wavefront_terms(
    const ArtifactProblem& problem,
    const ArtifactNoise& noise,
    const ArtifactParameters& parameters);

}  // namespace frangia
