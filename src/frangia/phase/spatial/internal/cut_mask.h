#pragma once

#include <cstddef>
#include <cstdint>

#include "frangia/core/image.h"
#include "frangia/phase/wrap/phase_map.h"

namespace frangia {

/// Masks of the smooth phase differences to the right-hand neighbour and to the neighbour below.
struct SmoothSteps {
  const Image<std::uint8_t>& right;
  const Image<std::uint8_t>& below;
};

/// Marks with 1 the pixels within a square of this radius around a cut: a phase difference between
/// two measured pixels that is not smooth.
///
/// @shape    w x h
/// @units    rad
[[nodiscard]] Image<std::uint8_t> mark_near_cuts(const Image<float>& phase_rad,
                                                 const SmoothSteps& smooth,
                                                 int radius_px);

/// Discards the four pixels of each residue and returns the number of discarded pixels.
///
/// @source   the paper's reference [34], Huntley 1989
std::size_t discard_residues(WrappedPhase& phase);

}  // namespace frangia
