#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "frangia/calibrate/artifact/internal/artifact_residuals.h"
#include "frangia/calibrate/internal/artifact_model.h"

namespace frangia {

/// A surface of a capture as the ray of a pixel meets it in one view.
[[nodiscard]] TurnedSurface turned_surface(const ArtifactProblem& problem,
                                           std::size_t capture,
                                           const ArtifactView& view,
                                           int surface,
                                           const Eigen::Vector2d& pixel);

/// Weights of both directions of the light at a site; 0 for one that is not measured. `noise`
/// scales the standard deviations.
[[nodiscard]] Eigen::Vector2d light_weight(const LightSite& site, double noise);

}  // namespace frangia
