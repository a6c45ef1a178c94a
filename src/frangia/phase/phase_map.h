#pragma once

#include <cstdint>

#include "frangia/core/image.h"
#include "frangia/pattern/pattern.h"

namespace frangia {

/// What became of a pixel, and why it went.
enum class PixelStatus : std::uint8_t {
  Measured,        ///< holds a phase
  Filled,          ///< discarded, then interpolated from the measured pixels around it
  Unmodulated,     ///< its fringes do not rise above its noise: background or shadow
  Saturated,       ///< at the white level in a frame
  Residue,         ///< in a 2 x 2 loop whose phase jumps do not sum to zero
  UncertainOrder,  ///< the chance of a wrong fringe order is too high
  Unresolved,      ///< its region's whole number of fringes is not known
  MixedPixel,      ///< sees two surfaces at a depth edge
  OutOfField       ///< no point in front of camera and projector has this phase
};

/// Phase within one fringe, of all pixels.
struct WrappedPhase {
  Pattern pattern;
  Image<float> phase_rad;          ///< (-pi, pi]; NaN where not measured
  Image<float> sigma_rad;          ///< standard deviation of `phase_rad`; NaN where not measured
  Image<float> modulation_counts;  ///< I0 gamma0 of the paper's equation (1), at every pixel
  Image<float> mean_counts;        ///< I0 plus light that is not the projector's, at every pixel
  Image<PixelStatus> status;
};

/// Phase that is continuous within a region, known there but for a whole number of fringes.
struct RelativePhase {
  Pattern pattern;
  Image<float> phase_rad;  ///< NaN where not measured
  Image<float> sigma_rad;
  Image<std::int32_t> region;  ///< 0, 1, ... from the largest; -1 where not measured
  int region_count = 0;
  Image<PixelStatus> status;
  /// Which pixel of its region the growth reached first (0), second (1), ...; -1 where not
  /// measured. Empty unless it was asked for.
  Image<std::int32_t> growth_order;
};

/// Phase counted from the projection axis or the projector's first column. Its own type, so that a
/// wrapped or a relative phase can never reach triangulation.
struct AbsolutePhase {
  Pattern pattern;
  Image<float> phase_rad;  ///< NaN where not measured
  Image<float> sigma_rad;
  Image<PixelStatus> status;
};

}  // namespace frangia
