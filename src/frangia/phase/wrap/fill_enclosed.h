#pragma once

#include <cstddef>

#include "frangia/phase/wrap/phase_map.h"

namespace frangia {

/// Which holes of the phase are filled.
struct FillOptions {
  std::size_t max_px = 100;  ///< largest hole that is filled
  double max_plane_deviation_rad =
      0.5;  ///< largest deviation of the surrounding measured pixels from a plane
};

/// Interpolates discarded pixels that measured pixels enclose: saturated highlights, residues, and
/// dark specks of a few pixels. A larger unmodulated patch may be a real hole and is not filled.
/// Filled pixels get the status Filled, and their sigma includes the deviation of the surrounding
/// pixels from a plane. Returns the number of filled pixels.
///
/// @units    px, rad
/// @source   the paper, section 2; Laplace's equation over the hole
std::size_t fill_enclosed(AbsolutePhase& phase, const FillOptions& options = {});

}  // namespace frangia
