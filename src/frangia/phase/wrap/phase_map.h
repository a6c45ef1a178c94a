#pragma once

#include <cstdint>

#include "frangia/core/image.h"
#include "frangia/pattern/pattern.h"

namespace frangia {

/// Status of a pixel, and the reason if it has no phase.
enum class PixelStatus : std::uint8_t {
  Measured,        ///< has a phase
  Filled,          ///< discarded, then interpolated from the surrounding measured pixels
  Unmodulated,     ///< modulation too low for its noise: background or shadow
  Saturated,       ///< at the white level in at least one frame
  Residue,         ///< in a 2 x 2 loop whose phase differences do not sum to zero
  UncertainOrder,  ///< probability of a wrong fringe order too high
  Unresolved,      ///< fringe order of its region unknown
  MixedPixel,      ///< sees two surfaces at a depth edge
  OutOfField,      ///< no point in front of camera and projector has this phase
  Contradicting    ///< its frames contradict each other: something else was seen in some of them
};

/// The phase modulo 2 pi of all pixels.
struct WrappedPhase {
  Pattern pattern;                 ///< pattern that was decoded
  Image<float> phase_rad;          ///< (-pi, pi]; NaN where not measured
  Image<float> sigma_rad;          ///< standard deviation of `phase_rad`; NaN where not measured
  Image<float> modulation_counts;  ///< I0 gamma0 of the paper's equation (1), at every pixel
  Image<float> mean_counts;        ///< I0 plus ambient light, at every pixel
  Image<PixelStatus> status;       ///< why a pixel is missing
  /// systematic standard uncertainty of phase_rad in rad; NaN where not measured; empty: no
  /// systematic part is known
  Image<float> systematic_rad;
  /// share of the variance of `systematic_rad`, 0 to 1, by causes whose error at a point of the
  /// surface differs from view to view: harmonics and flicker
  float differing_share = 0.0F;
};

/// A phase that is continuous within each region and known up to a whole number of fringes per
/// region.
struct RelativePhase {
  Pattern pattern;             ///< pattern that was decoded
  Image<float> phase_rad;      ///< NaN where not measured
  Image<float> sigma_rad;      ///< standard deviation of `phase_rad`; NaN where not measured
  Image<std::int32_t> region;  ///< 0, 1, ... from the largest; -1 where not measured
  int region_count = 0;        ///< number of regions
  Image<PixelStatus> status;   ///< why a pixel is missing
  /// Order in which quality-guided growth reached the pixels of a region, from 0; -1 where not
  /// measured. Empty unless requested.
  Image<std::int32_t> growth_order;
  /// systematic standard uncertainty of phase_rad in rad; NaN where not measured; empty: no
  /// systematic part is known
  Image<float> systematic_rad;
};

/// The phase relative to the projection axis or the projector's first column. It is a separate type
/// so that a wrapped or a relative phase cannot be triangulated.
struct AbsolutePhase {
  Pattern pattern;            ///< pattern that was decoded
  Image<float> phase_rad;     ///< NaN where not measured
  Image<float> sigma_rad;     ///< standard deviation of `phase_rad`; NaN where not measured
  Image<PixelStatus> status;  ///< why a pixel is missing
  /// systematic standard uncertainty of phase_rad in rad; NaN where not measured; empty: no
  /// systematic part is known
  Image<float> systematic_rad;
  /// share of the variance of `systematic_rad`, 0 to 1, by causes whose error at a point of the
  /// surface differs from view to view: harmonics and flicker
  float differing_share = 0.0F;
};

}  // namespace frangia
