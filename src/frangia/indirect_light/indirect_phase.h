#pragma once

#include <span>

#include "frangia/indirect_light/view_light.h"
#include "frangia/pattern/pattern.h"

namespace frangia {

/// How a sequence obtains the absolute phase of its finest pattern.
enum class PhaseSource {
  Finest,  ///< from the finest pattern alone; the coarser ones give its order, one after the other
  Slope    ///< from the least-squares slope of phase over frequency through all patterns
};

/// What indirect light does to the absolute phase of the finest pattern.
struct IndirectPhase {
  double error_rad = 0.0;  ///< predicted
  /// Standard uncertainty of the prediction.
  double sigma_rad = 0.0;
  bool wrong_order = false;  ///< coarser patterns are off by so much that they give a wrong order
};

/// Predicts the phase error of a surface with this reflectance: what the sequence makes of the
/// errors arg(1 + f) of its patterns.
///
/// The uncertainty is the error itself, half of the share of indirect fringes, and all of the share
/// that surface which was not measured may add: at a crease the measured surface is distorted by
/// the error that it predicts, and further bounces and shine are not predicted.
///
/// @shape    `patterns` and `share.fringes` coarse to fine
/// @units    rad
[[nodiscard]] IndirectPhase indirect_phase(const IndirectShare& share,
                                           double albedo,
                                           std::span<const Pattern> patterns,
                                           PhaseSource source);

/// The phase of the direct light.
struct SolvedPhase {
  double phase_rad = 0.0;    ///< of the finest pattern
  bool wrong_order = false;  ///< as in IndirectPhase
};

/// Solves for the phase that, together with the indirect light, gives the measured one. The
/// indirect light stays as it is while the point moves, so the solution does not depend on where
/// the point was assumed.
///
/// @param share         as predicted for a point with the phase `assumed_rad`
/// @param assumed_rad   phase at which the point was predicted
/// @param measured_rad  phase of the frames
/// @param albedo        reflectance of the surface, 0 to 1
/// @param patterns      of one direction, coarse to fine
/// @param source        which maps the phase was computed from
/// @units    rad, of the finest pattern
[[nodiscard]] SolvedPhase direct_phase(const IndirectShare& share,
                                       double assumed_rad,
                                       double measured_rad,
                                       double albedo,
                                       std::span<const Pattern> patterns,
                                       PhaseSource source);

}  // namespace frangia
