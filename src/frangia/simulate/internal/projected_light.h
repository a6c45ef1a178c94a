#pragma once

#include <complex>

#include <Eigen/Core>

#include "frangia/pattern/pattern.h"
#include "frangia/simulate/internal/simulated_scene.h"

namespace frangia {

/// Phase of a fringe pattern at a projector coordinate: psi in degrees, or column and row.
///
/// @units    rad
[[nodiscard]] double phase_at(const Pattern& pattern, const Eigen::Vector2d& at);

/// Light of a fringe whose real part is the cosine of the phase, relative to the mean light,
/// blurred along the phase by the projector's Gaussian. The display's response is part of it; a
/// dithered fringe is a sine.
[[nodiscard]] double shown_fringe(const std::complex<double>& fringe,
                                  double period_px,
                                  const SimulatedScene& scene);

/// Light of a dithered fringe at a projector coordinate, blurred across the pixels by the
/// projector's Gaussian. `shift` turns its phase.
[[nodiscard]] double dithered_light(const Pattern& pattern,
                                    const Eigen::Vector2d& at,
                                    const std::complex<double>& shift,
                                    const SimulatedScene& scene);

/// Light of a frame that is not a fringe at a projector coordinate: of its pictures where it
/// has any.
[[nodiscard]] double frame_light(const Pattern& pattern,
                                 int frame,
                                 const Eigen::Vector2d& at,
                                 const Shot& shot,
                                 const SimulatedScene& scene);

}  // namespace frangia
