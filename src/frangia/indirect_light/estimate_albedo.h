#pragma once

#include <span>
#include <vector>

#include "frangia/indirect_light/view_light.h"
#include "frangia/pattern/pattern.h"

namespace frangia {

/// What one pattern's frames measured at a pixel.
struct MeasuredFringe {
  float contrast_inverse = 0.0F;    ///< mean over modulation
  float modulation_inverse = 0.0F;  ///< 1 / counts
  float sigma_rad = 0.0F;  ///< noise of the phase, and of the modulation relative to itself
  /// Wrapped phase minus the one that the absolute phase of the finest pattern demands.
  float residual_rad = 0.0F;
};

/// A pixel: what was predicted and what was measured.
struct AlbedoSample {
  IndirectShare predicted;               ///< by the mesh, if all light were reflected
  std::vector<MeasuredFringe> measured;  ///< coarse to fine, as `predicted.fringes`
};

/// The reflectance that explains the frames.
struct AlbedoEstimate {
  double albedo = 0.0;  ///< 0 to 1; 0 when indirect light does not explain the frames better
  /// Whether it does, also in samples that it was not fitted to; never at the upper bound.
  bool significant = false;
  /// Sum of squared residuals over their expectation, per sample that sees lit surface: of no
  /// indirect light, less that of `albedo`.
  double improvement = 0.0;
  /// Share of the squared residuals of no indirect light that remains with `albedo`.
  double unexplained = 1.0;
};

/// Estimates the reflectance of a surface from what indirect light does to its frames: it lowers
/// the contrast where a point sees lit surface, and shifts the phases of coarse and fine fringes
/// differently. Each pattern has an unknown contrast of its own, and there may be ambient light.
/// A single pattern decides by its contrast alone.
///
/// @shape    `patterns` coarse to fine
[[nodiscard]] AlbedoEstimate estimate_albedo(std::span<const AlbedoSample> samples,
                                             std::span<const Pattern> patterns);

}  // namespace frangia
