#pragma once

#include <span>
#include <string>

#include "frangia/phase/wrap/phase_map.h"

namespace frangia {

/// Whether coarse and fine patterns of a view disagree where the surface is smooth: light that
/// reaches a point by way of other parts of the surface shifts coarse fringes more than fine ones.
struct IndirectLightCheck {
  /// More than 1 % of the pixels disagree, by more than twice the known error of any pattern.
  bool found = false;
  double affected = 0.0;          ///< share of the pixels that disagree beyond their noise
  double disagreement_rad = 0.0;  ///< RMS over these pixels, of the pattern that disagrees most
  std::string pattern;            ///< that pattern
  /// Median modulation of the finest pattern relative to that of the coarsest one. Below 1 the
  /// projector is out of focus, or light is scattered below the surface.
  double modulation_ratio = 1.0;
};

/// Compares the patterns of one direction and, if they disagree, adds what the disagreement means
/// for the absolute phase to its systematic part, pixel by pixel.
///
/// Residuals are means over 5 x 5 pixels without a step, and count from four standard deviations
/// on. The share of indirect fringes falls with their period, in the limits as the period and not
/// at all: the error of the finest pattern is taken as that of the coarser one times the root of
/// the ratio of their periods.
///
/// @shape    `coarse_to_fine` and `phase` w x h; `phase` that of the finest pattern
/// @units    rad
[[nodiscard]] IndirectLightCheck check_indirect_light(std::span<const WrappedPhase> coarse_to_fine,
                                                      AbsolutePhase& phase);

/// One sentence about what was found and what to do, without a full stop.
[[nodiscard]] std::string describe(const IndirectLightCheck& check);

}  // namespace frangia
