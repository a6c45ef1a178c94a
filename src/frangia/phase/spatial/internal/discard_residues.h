#pragma once

#include <cstddef>

#include "frangia/phase/wrap/phase_map.h"

namespace frangia {

/// Discards the four pixels of each residue and returns the number of discarded pixels.
///
/// @source   the paper's reference [34], Huntley 1989
std::size_t discard_residues(WrappedPhase& phase);

}  // namespace frangia
