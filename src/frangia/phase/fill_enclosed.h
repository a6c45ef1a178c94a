#pragma once

#include <cstddef>

#include "frangia/phase/phase_map.h"

namespace frangia {

struct FillOptions {
  std::size_t max_px = 100;  ///< a larger hole stays open
  double max_plane_deviation_rad =
      0.5;  ///< measured pixels around it must lie on a plane to within this
};

/// Interpolates discarded pixels that measured ones enclose: saturated highlights, residues, and
/// dark specks of a few pixels. A larger unmodulated patch may be a true hole and stays one. Filled
/// pixels are marked, and their sigma holds how far those around them depart from a plane.
/// Returns how many were filled.
///
/// source   the paper, section 2; a membrane (Laplace) over the hole
std::size_t fill_enclosed(AbsolutePhase& phase, const FillOptions& options = {});

}  // namespace frangia
